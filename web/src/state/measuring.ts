/** State of measuring: answers of the engine about the picked vessel and the findings, and what is not ended yet. */
import { batch, signal } from '@preact/signals';
import type { Findings, LineId, Spot, Stenosis, Stretch } from '../core/messages';

/** Whether measuring was opened, and the section has not moved to the narrowest place yet. */
export const isArriving = signal(false);

export function endArriving(): void {
  isArriving.value = false;
}

/** A length that the user has begun: the line of the vessel, and the arc length at which the length begins (mm). */
export const begunLength = signal<{ readonly line: LineId; readonly at: number } | null>(null);

export function beginLengthAt(line: LineId, at: number): void {
  begunLength.value = { line, at };
}

export function dropLength(): void {
  begunLength.value = null;
}

/** Whether the dragged reference has passed the stenosis; then the keys of the two reference handles are swapped. */
export const isCrossed = signal(false);

export function setCrossed(isNow: boolean): void {
  isCrossed.value = isNow;
}

export type Suggested = readonly [Spot | null, Spot | null];
export const NOTHING_SUGGESTED: Suggested = [null, null];

export interface Answers {
  readonly suggested: Suggested;
  readonly stenosis: Stenosis | null;
  /** The diameter of the marked place, and why there is no percentage. */
  readonly notGraded: string | null;
  /** A place that is narrower than the marked one. */
  readonly narrower: string | null;
  /** Doubts about the stenosis percentage; if nothing is marked, about that of the suggested places. */
  readonly doubts: readonly string[];
  readonly stretch: Stretch | null;
  readonly secondStretch: Stretch | null;
  /** Angle between the two stretches (radians). */
  readonly angle: number | null;
}

export const NO_ANSWERS: Answers = {
  suggested: NOTHING_SUGGESTED,
  stenosis: null,
  notGraded: null,
  narrower: null,
  doubts: [],
  stretch: null,
  secondStretch: null,
  angle: null,
};

export const answers = signal<Answers>(NO_ANSWERS);

export function takeAnswers(found: Answers): void {
  answers.value = found;
}

/** Findings that the user has left out of the report. */
export const leftOut = signal<ReadonlySet<LineId>>(new Set());

export function leaveOut(line: LineId, isOut: boolean): void {
  const others = [...leftOut.value].filter((other) => other !== line);
  leftOut.value = new Set(isOut ? [...others, line] : others);
}

/** The sentences about all findings; null until the engine has answered. */
export const findingSentences = signal<Findings | null>(null);

export function takeSentences(found: Findings | null): void {
  findingSentences.value = found ?? findingSentences.value;
}

export function forgetFindings(): void {
  batch(() => {
    leftOut.value = new Set();
    findingSentences.value = null;
  });
}
