import { expect, test } from 'vitest';
import type { Pick, Vector } from '../src/core/messages';
import { jumpTo, moveCrossHair, moveTo, placeAnswer } from '../src/state/cross-hair';
import { crossHair, pickVessel } from '../src/state/store';
import { connect, engine } from '../src/worker/engine';

const [EARLIER, LATER]: [Vector, Vector] = [
  [1, 2, 3],
  [4, 5, 6],
];

/** An engine that answers only when told to. */
function slowEngine(): (() => Promise<void>)[] {
  const answers: (() => Promise<void>)[] = [];
  const ask = (name: string, asked: unknown): Promise<unknown> =>
    new Promise((resolve) => {
      const point = name === 'at' ? (asked as Vector) : EARLIER;
      const pick: Pick = { point, value: 7, vessel: null, arc_length: null } as Pick;
      answers.push(async () => {
        resolve(name === 'at' ? pick : [EARLIER]);
        await new Promise((later) => setTimeout(later));
      });
    });
  connect({ ask } as never);
  return answers;
}

test('a late answer does not undo a later movement of the cross-hair', async () => {
  const answers = slowEngine();
  moveCrossHair(EARLIER, 'axial');
  moveCrossHair(LATER, 'axial');
  expect(crossHair.value?.point).toEqual(LATER);
  await answers[0]?.();
  expect(crossHair.value).toMatchObject({ point: LATER, value: null });
  await answers[1]?.();
  expect(crossHair.value).toMatchObject({ point: LATER, value: 7 });
});

test('a late answer of the section does not undo a movement in a slice', async () => {
  const answers = slowEngine();
  pickVessel(0, 0);
  moveTo(0);
  moveCrossHair(LATER, 'axial');
  await answers[0]?.();
  await answers[2]?.();
  expect(crossHair.value?.point).toEqual(LATER);
});

test('a late answer about a click does not undo a movement along the vessel', async () => {
  const answers = slowEngine();
  jumpTo(LATER);
  pickVessel(0, 0);
  const placed = placeAnswer(engine.ask('at', EARLIER), 'turning');
  moveTo(0);
  await answers[0]?.();
  await placed;
  expect(crossHair.value?.point).toEqual(LATER);
});
