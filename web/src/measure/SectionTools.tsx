/** Buttons next to the line of the section, which mark the place there. */
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import { pickedPlace } from '../state/store';
import { leftOf } from './chart-layout';
import { currentMarks } from './current';
import { beginLength, endLength, lengthFrom, markHere, noteDiameter } from './editing';
import { isFull } from './marks';
import { mm } from './words';

export const TOOLS = 28;
interface SectionToolsProps {
  readonly column: number;
  readonly width: number;
  readonly top: number;
}

export function SectionTools({ column, width, top }: SectionToolsProps) {
  const marks = currentMarks.value;
  const bar = useRef<HTMLDivElement>(null);
  const [wide, setWide] = useState(0);
  // The width of the bar changes when a length begins, so read it after every render.
  useLayoutEffect(() => setWide(bar.current?.offsetWidth ?? 0));
  if (!marks) {
    return null;
  }
  const at = mm(pickedPlace.value, 1);
  return (
    <div
      class="section-tools"
      role="toolbar"
      aria-label={`At the section, ${at}`}
      ref={bar}
      style={{ top: `${top}px`, left: `${leftOf(column, wide, width)}px` }}
    >
      <button
        type="button"
        class="small"
        title={`Marks the narrowest place of the stenosis at ${at}`}
        onClick={() => markHere('place')}
      >
        Narrowest here
      </button>
      <button
        type="button"
        class="small"
        title={`Marks the normal lumen at ${at} as a reference for the stenosis`}
        onClick={() => markHere('reference')}
      >
        Reference here
      </button>
      <button type="button" class="small" title={`Notes the diameter at ${at}`} onClick={noteDiameter}>
        Diameter here
      </button>
      <LengthButton hasRoom={!isFull(marks)} />
    </div>
  );
}

/** Button for a length along the vessel: the first press begins it at the section, the second ends it there. */
function LengthButton({ hasRoom }: { readonly hasRoom: boolean }) {
  const from = lengthFrom.value;
  if (from === null) {
    const title = hasRoom
      ? 'Starts a length here; then move the section to the other end'
      : 'Two stretches are marked: remove one first';
    return (
      <button type="button" class="small" disabled={!hasRoom} title={title} onClick={beginLength}>
        Length from here
      </button>
    );
  }
  const length = Math.abs(pickedPlace.value - from);
  return (
    <button type="button" class="small" aria-pressed="true" title={`From ${mm(from, 1)}`} onClick={endLength}>
      {`Length to here: ${mm(length, 1)}`}
    </button>
  );
}
