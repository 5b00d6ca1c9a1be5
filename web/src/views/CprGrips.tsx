/** Grips of the picked vessel's line in the straightened view. A drag moves the line sideways in the picture. */
import { useRef, useState } from 'preact/hooks';
import type { DocumentVessel, Pair } from '../core/messages';
import { forgetLinePreview, previewLine, reshapeLine } from '../edit/reshaping';
import { Handle } from '../pane/Handle';
import { nameOf } from '../state/changes';
import { recover } from '../state/device';
import { isReshaping } from '../state/reshaping';
import { tree } from '../state/shown';
import { pickedVessel } from '../state/store';
import { engine } from '../worker/engine';
import { APART_PX } from './line-grips';

interface CprGripsProps {
  readonly size: Pair;
  readonly spacing: number;
  readonly left: number;
}

export function CprGrips({ size, spacing, left }: CprGripsProps) {
  const vessel = tree.value[pickedVessel.value ?? -1];
  if (!isReshaping.value || !vessel) {
    return null;
  }
  const count = Math.floor(size[1] / APART_PX);
  return (
    <>
      {Array.from({ length: count }, (_, n) => (
        <CprGrip
          key={n}
          vessel={vessel}
          number={n + 1}
          place={[size[0] / 2, ((n + 0.5) * size[1]) / count]}
          spacing={spacing}
          left={left}
        />
      ))}
    </>
  );
}

interface CprGripProps {
  readonly vessel: DocumentVessel;
  readonly number: number;
  readonly place: Pair;
  readonly spacing: number;
  readonly left: number;
}

function CprGrip({ vessel, number, place: [middle, row], spacing, left }: CprGripProps) {
  const [by, setBy] = useState(0);
  const wanted = useRef(0);
  const asking = useRef<Promise<void> | null>(null);
  const follow = async (): Promise<void> => {
    for (let shown = Number.NaN; shown !== wanted.current; ) {
      shown = wanted.current;
      const found = await engine.ask('pick_straightened', { pixel: [middle + shown, row] }).catch(recover);
      if (found) {
        previewLine(vessel.line, { kind: 'bend', at: row * spacing, to: found.point });
      }
    }
    asking.current = null;
  };
  const move = (to: number) => {
    setBy(to);
    wanted.current = to;
    asking.current ??= follow();
  };
  const end = (last: () => unknown) =>
    void Promise.resolve(asking.current)
      .then(last)
      .then(() => setBy(0));
  return (
    <Handle
      at={[left + middle + by, row]}
      words={`Grip ${number} of the line of ${nameOf(vessel)} in the straightened vessel`}
      color={vessel.color}
      kind="grip line-grip"
      onDrag={([column]) => move(column - left - middle)}
      onArrow={([right]) => move(right)}
      onEnd={() => end(() => reshapeLine(vessel.id))}
      onPutBack={() => end(forgetLinePreview)}
    />
  );
}
