/** Bar over the views: offers to trace, tells what the next click does, or shows a doubtful branch. */
import { useSignal } from '@preact/signals';
import { findAndList } from '../edit/branches';
import { STOPPER } from '../edit/clicks';
import { answerDoubt, placeOfDoubt, stepDoubt } from '../edit/doubts';
import { performAny } from '../edit/performing';
import { acceptCandidate, endVessel, takeWhole } from '../edit/pointing';
import { nameOf, vesselOf } from '../state/changes';
import { candidate, coming, drawn, isDrawing, only, tracedSummary, whole } from '../state/drawing';
import { editQueue } from '../state/edit-queue';
import { document_ } from '../state/history';
import { findAllTitle, kind } from '../state/kind';
import { hasVolume, report } from '../state/store';
import { chosenDoubt, isTracing, type Tool, takeTool, tool } from '../state/tool';
import { DarkSwitch } from './DarkSwitch';
import { OpenMore } from './OpenButtons';
import { TracedSummary } from './TracedSummary';

export function TraceBar() {
  const doubt = vesselOf(document_.value, chosenDoubt.value);
  if (isTracing()) {
    return <Hint />;
  }
  // A vessel that the user has ended appears once all its points are traced.
  if (coming.value.length > 0) {
    return (
      <div class="trace-bar" role="status">
        <span>Tracing …</span>
      </div>
    );
  }
  if (doubt?.doubt) {
    return <Doubt words={`${nameOf(doubt)} is doubtful: ${doubt.doubt}`} />;
  }
  return hasVolume.value && document_.value.vessels.length === 0 ? (
    <Offer key={report.value?.volume} />
  ) : null;
}

function Offer() {
  const isClosed = useSignal(false);
  if (isClosed.value) {
    return null;
  }
  return (
    <div class="trace-bar offer" role="note">
      <span>{`No ${kind.value.several} yet: find all, click along one, or open or drop centerlines or a mask.`}</span>
      <button
        type="button"
        disabled={editQueue.isBusy}
        title={findAllTitle()}
        onClick={() => void findAndList()}
      >
        Find all {kind.value.several}
      </button>
      <button type="button" onClick={() => performAny('trace')}>
        Trace one {kind.value.one}
      </button>
      <DarkSwitch />
      <OpenMore words="I have centerlines" />
      <button
        type="button"
        aria-label="Close these suggestions"
        onClick={() => {
          isClosed.value = true;
        }}
      >
        ✕
      </button>
    </div>
  );
}

const WHOLE =
  'Traces what was clicked to its end, starting where it leaves a line of the list (key w). The first use searches the whole scan.';

function Hint() {
  const take = (wanted: Tool) => () => takeTool(wanted);
  // The summary is hidden while a point waits for confirmation or is being traced.
  const isSummaryShown = !editQueue.isBusy && !candidate.value && (!isDrawing.value || drawn.value !== null);
  return (
    <div class="trace-bar" role="status">
      {isSummaryShown && <TracedSummary />}
      {!(isSummaryShown && tracedSummary.value?.doubts.length) && <span>{hintWords()}</span>}
      {candidate.value && (
        <button type="button" onClick={() => acceptCandidate()}>
          Set the point here
        </button>
      )}
      {only.value && (
        <button type="button" title={WHOLE} onClick={() => takeWhole()}>
          Whole {kind.value.one}
        </button>
      )}
      {isDrawing.value && !candidate.value && tool.value === 'trace' && (
        <button type="button" onClick={endVessel}>
          End this {kind.value.one}
        </button>
      )}
      {tool.value !== 'seed' && (
        <button
          type="button"
          title={tool.value === 'trace' ? STOPPER : 'Return to placing points on vessels'}
          onClick={take(tool.value === 'trace' ? 'stopper' : 'trace')}
        >
          {tool.value === 'trace' ? 'Stopper' : 'Trace'}
        </button>
      )}
      <DarkSwitch />
      <button type="button" onClick={take('look')}>
        Done
      </button>
    </div>
  );
}

function hintWords(): string {
  if (editQueue.isBusy) {
    return editQueue.isSearching ? `Searching for ${kind.value.several} …` : 'Tracing …';
  }
  if (candidate.value) {
    const { one, brightest } = kind.value;
    return `The marker is at the ${brightest} point under the pointer. If the slices show your ${one} there, click here again; otherwise click the ${one} in a slice.`;
  }
  if (tool.value === 'seed') {
    return 'Click where the tree begins, or press Enter at the cross-hair, to find all branches from there.';
  }
  if (tool.value === 'stopper') {
    return 'Click where no line may pass, or press Enter to choose the position of the cross-hair.';
  }
  if (drawn.value) {
    return `Add a point further along ${nameOf(drawn.value)}: click, or press Enter at the cross-hair. A double click ends the ${kind.value.one}.`;
  }
  const taken = whole.value ? `: ${whole.value.words}` : '';
  return isDrawing.value
    ? `Press Enter or double-click to trace the whole ${kind.value.one}${taken}. Or add a point further along it.`
    : `Click where ${an(kind.value.one)} begins, or press Enter to choose the position of the cross-hair.`;
}

const an = (one: string): string => `${one.startsWith('a') ? 'an' : 'a'} ${one}`;

/** Shows a doubtful branch. After the user accepts it or leaves it out, the next one is shown. */
function Doubt({ words }: { readonly words: string }) {
  const [place, count] = placeOfDoubt();
  return (
    <div class="trace-bar over" role="status">
      <span>{words}</span>
      <button type="button" title="Accept (y)" onClick={() => void answerDoubt('accept')}>
        Accept
      </button>
      <button type="button" title="Leave out (n)" onClick={() => void answerDoubt('leave out')}>
        Leave out
      </button>
      {count > 1 && (
        <>
          <button type="button" aria-label="Previous (,)" onClick={() => stepDoubt(-1)}>
            ‹
          </button>
          <span>{`${place + 1} of ${count}`}</span>
          <button type="button" aria-label="Next (.)" onClick={() => stepDoubt(1)}>
            ›
          </button>
        </>
      )}
    </div>
  );
}
