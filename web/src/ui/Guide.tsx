/** The guided tour with a phantom: its steps, each of which ends when the user has done what it asks, and their box. */

import { effect } from '@preact/signals';
import type { Vector } from '../core/messages';
import { dot } from '../core/vectors';
import { EMPTY } from '../state/document';
import { document_ } from '../state/history';
import { goToGuideStep, guideStep } from '../state/panels';
import { beginDocument } from '../state/shown';
import * as store from '../state/store';
import { isTracing } from '../state/tool';
import { openPhantom } from '../study/study';

export function Guide() {
  const number = guideStep.value;
  const step = number === null ? null : STEPS[number];
  if (number === null || !step) {
    return null;
  }
  const isLast = number === STEPS.length - 1;
  return (
    <aside class="guide" aria-label="Guided tour" aria-live="polite">
      <div class="guide-words">
        <h2>{`${number + 1} of ${STEPS.length}: ${step.title}`}</h2>
        <p>{wordsOf(step).join(' ')}</p>
      </div>
      <div class="guide-buttons">
        {!isLast && (
          <button type="button" onClick={nextStep}>
            Skip this step
          </button>
        )}
        <button type="button" onClick={leaveGuide}>
          {isLast ? 'Finish' : 'Leave the tour'}
        </button>
      </div>
    </aside>
  );
}

interface GuideStep {
  readonly title: string;
  readonly words: readonly string[] | (() => readonly string[]);
  readonly isDone: () => boolean;
}

/** The step "Turn it" is done after a turn of 20°; this is the cosine. */
const COS_MIN_TURN = Math.cos(Math.PI / 9);

let directionAtFirst: Vector | null = null;

const isTraced = (): boolean => document_.value.vessels.some((vessel) => (vessel.clicks?.length ?? 0) >= 2);

/** The text depends on the progress: the slices appear only once the tracing tool is active. */
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
      'From every direction, you see the vessel cut open along its centerline.',
    ],
    isDone: () => {
      const camera = store.camera.value;
      return (
        camera !== null && directionAtFirst !== null && dot(camera.direction, directionAtFirst) < COS_MIN_TURN
      );
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
      'Drag each to the right place, or press “Confirm the suggested places”.',
      'This phantom has a stenosis of 50 %. Compare it with the displayed percentage and its uncertainty (±).',
    ],
    isDone: () => Object.values(document_.value.marks).some((marks) => marks.at !== null),
  },
  {
    title: 'Save it',
    words: [
      'Open “Save” and choose the report: one page with pictures and numbers that opens offline.',
      'To continue later, save the session as a separate file.',
    ],
    isDone: () => false,
  },
];

export async function startGuide(): Promise<void> {
  await openPhantom('stenosis');
  if (store.report.value) {
    beginDocument(EMPTY);
    goToGuideStep(0);
  }
}

function leaveGuide(): void {
  goToGuideStep(null);
}

function nextStep(): void {
  const step = guideStep.peek();
  if (step !== null) {
    goToGuideStep(step + 1 < STEPS.length ? step + 1 : null);
  }
}

/** Goes to the next step when the user has completed one. Closing the study ends the tour. */
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
        // Several signals may change at once, so check the step again before advancing.
        nextStep();
      }
    });
  });
}
