import { expect, test } from 'vitest';
import type { Asked, LineContent } from '../src/core/messages';
import { EMPTY } from '../src/state/document';
import { handedOver } from '../src/study/saving';

const line = (end: number): LineContent => ({
  points: [
    [0, 0, 0],
    [0, 0, end],
  ],
  radius: null,
  confidence: null,
  bridged: null,
  by_hand: null,
});

const vessel = (id: number, number: number) => ({
  id,
  line: number,
  name: `Vessel ${id}`,
  color: '#ff0000',
  isHidden: false,
  clicks: null,
  doubt: null,
  contours: [],
});

test('vessels keep all but their line numbers; vessels whose lines are not loaded are dropped', async () => {
  const taken: unknown[] = [];
  const other = {
    ask: (name: string, message: unknown) => {
      taken.push([name, message]);
      return Promise.resolve(taken.length - 1);
    },
  } as unknown as Asked;
  const contents = new Map([
    [7, line(1)],
    [3, line(2)],
  ]);
  const document = { ...EMPTY, bridge: true, vessels: [vessel(1, 7), vessel(2, 5), vessel(4, 3)] };
  expect(await handedOver(other, document, contents)).toEqual({
    ...document,
    vessels: [vessel(1, 0), vessel(4, 1)],
  });
  expect(taken).toEqual([
    ['add_line', line(1)],
    ['add_line', line(2)],
  ]);
});
