/** The guided tour: a phantom, and one step after the other, each done once the user did it. */
import { effect, signal } from '@preact/signals';
import { engine } from '../client/shared';
import type { Vector } from '../core/messages';
import { dot } from '../core/vectors';
import { isTracing } from '../edit/mode';
import { beginDocument } from '../edit/shown';
import { EMPTY } from '../state/document';
import { document_ } from '../state/history';
import * as store from '../state/store';
import { openPhantom } from '../study/study';

export interface GuideStep {
  readonly title: string;
  /** What to do, one sentence each. */
  readonly words: readonly string[] | (() => readonly string[]);
  readonly isDone: () => boolean;
}

/** The least turn that counts as one (cosine of 20°). */
const TURNED = Math.cos(Math.PI / 9);

/** The step that is under way, counted from 0; null where there is no guided tour. */
export const guideStep = signal<number | null>(null);

/** Where the camera looked as the step began. */
let directionAtFirst: Vector | null = null;

const isTraced = (): boolean => document_.value.vessels.some((vessel) => (vessel.clicks?.length ?? 0) >= 2);

/** One thing after the other: the slices are shown only once the tool is in use. */
function tracingWords(): readonly string[] {
  if (!isTracing()) {
    return ['Press “Trace” or the key t.', 'Three slice views open.'];
  }
  return isTraced()
    ? ['Lumencut found the centerline between your points.', 'Now press “Done”.']
    : [
        'In the coronal slice, click on the bright vessel near its upper end, then near its lower end.',
        'Lumencut finds the centerline between the clicks; then press “Done”.',
      ];
}

/** What to do in a step now. */
export const wordsOf = ({ words }: GuideStep): readonly string[] =>
  typeof words === 'function' ? words() : words;

export const STEPS: readonly GuideStep[] = [
  {
    title: 'Trace the vessel',
    words: tracingWords,
    isDone: () => isTraced() && !isTracing(),
  },
  {
    title: 'Turn it',
    words: [
      'Drag in the view “Vessels”.',
      'The vessel is cut open along its centerline from every direction.',
    ],
    isDone: () => {
      const camera = store.camera.value;
      return camera !== null && directionAtFirst !== null && dot(camera.direction, directionAtFirst) < TURNED;
    },
  },
  {
    title: 'Measure it',
    words: [
      'Press “Measure”, or the key m.',
      'Below the straightened vessel you see its diameter from one end to the other.',
    ],
    isDone: () => store.layout.value === 'measure',
  },
  {
    title: 'Grade the stenosis',
    words: [
      'The narrowest place and its references are suggested. They are not findings until you confirm them.',
      'Check them, drag them where they belong, or press “Confirm the suggested places”.',
      'This phantom has a stenosis of 50 %: compare the percentage and its ± with that.',
    ],
    isDone: () => Object.values(document_.value.marks).some((marks) => marks.at !== null),
  },
  {
    title: 'Save it',
    words: [
      'Open “Save” and choose the report: one page with pictures and numbers that opens offline.',
      'Save the session, a separate file, to continue later.',
    ],
    isDone: () => false,
  },
];

/** Opens the phantom without its centerlines, and begins. */
export async function startGuide(): Promise<void> {
  await openPhantom(engine, 'stenosis');
  if (store.report.value) {
    beginDocument(EMPTY);
    guideStep.value = 0;
  }
}

export function leaveGuide(): void {
  guideStep.value = null;
}

/** Goes on to the next step, or ends after the last one. */
export function nextStep(): void {
  const step = guideStep.peek();
  if (step !== null) {
    guideStep.value = step + 1 < STEPS.length ? step + 1 : null;
  }
}

/** Goes on by itself whenever the user has done what a step asks for; the try ends with its study. */
export function followGuide(): void {
  effect(() => {
    const step = guideStep.value;
    directionAtFirst = store.camera.peek()?.direction ?? null;
    if (step === null) {
      return;
    }
    return effect(() => {
      if (store.report.value === null) {
        leaveGuide();
      } else if (guideStep.peek() === step && STEPS[step]?.isDone()) {
        // Where several things change at once this is asked again before the next step takes its place.
        nextStep();
      }
    });
  });
}
