/** Box over the views with the current step of the guided tour. */
import { guideStep } from '../state/panels';
import { leaveGuide, nextStep, STEPS, wordsOf } from './guide-steps';

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
