/** Shows the measurements at the pointer, or else at the section. A click moves the section. */
import type { ComponentChildren, TargetedPointerEvent } from 'preact';
import type { Axis, Profile } from '../core/messages';
import { moveAlong, moveTo } from '../state/cross-hair';
import * as store from '../state/store';
import { valueAt } from './layout';
import { sectionNumbers, snapped } from './sections';
import { sectionWords } from './words';

/** Movement per press of an arrow key (mm); with Shift ten times as far. */
const STEP = 0.5;

interface ProfileReadingProps {
  readonly profile: Profile;
  readonly x: Axis;
  readonly top: number;
  readonly hovered: number | null;
  onHover(at: number | null): void;
  readonly children: ComponentChildren;
}

export function ProfileReading({ profile, x, top, hovered, onHover, children }: ProfileReadingProps) {
  const placeOf = (event: TargetedPointerEvent<HTMLDivElement>) =>
    snapped(profile, valueAt(x, event.clientX - event.currentTarget.getBoundingClientRect().left));
  const moved = (event: TargetedPointerEvent<HTMLDivElement>) => {
    onHover(placeOf(event));
    if (event.currentTarget.hasPointerCapture(event.pointerId)) {
      moveTo(placeOf(event));
    }
  };
  const pressed = (event: TargetedPointerEvent<HTMLDivElement>) => {
    if (event.button === 0) {
      event.currentTarget.setPointerCapture(event.pointerId);
      moveTo(placeOf(event));
    }
  };
  const section = sectionNumbers(profile, hovered ?? store.pickedPlace.value);
  return (
    <div
      class="chart"
      data-testid="chart"
      role="application"
      aria-label="profile: arrow keys move the section"
      tabIndex={0}
      style={{ top: `${top}px` }}
      onPointerDown={pressed}
      onPointerMove={moved}
      onPointerLeave={() => onHover(null)}
      onKeyDown={keyed}
    >
      {children}
      <output class="chart-reading" data-testid="chart-reading">
        {sectionWords(section)}
      </output>
    </div>
  );
}

function keyed(event: KeyboardEvent): void {
  const steps = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (steps) {
    event.preventDefault();
    event.stopPropagation();
    moveAlong(steps * STEP * (event.shiftKey ? 10 : 1));
  }
}
