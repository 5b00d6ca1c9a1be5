/** What the page is used for now: looking, tracing, measuring or reporting. */
import { isTracing } from '../edit/mode';
import { toggleLayout } from '../state/actions';
import { hasVolume, layout } from '../state/store';
import { tool } from '../state/tool';

type Mode = 'look' | 'trace' | 'measure' | 'report';

/** The mode that the page is in. */
function mode(): Mode {
  if (isTracing()) {
    return 'trace';
  }
  const shown = layout.value;
  return shown === 'measure' || shown === 'report' ? shown : 'look';
}

/**
 * Goes to a mode; each one lays down what it took up. A second press, as of a reader who has not yet seen the first one's
 * answer, leaves it on: "Look" is the way out.
 */
function change(to: Mode): void {
  const from = mode();
  if (from === to) {
    return;
  }
  if (to === 'trace') {
    tool.value = 'trace';
  } else if (to === 'measure' || to === 'report') {
    toggleLayout(to);
  } else if (from === 'measure' || from === 'report') {
    toggleLayout(from);
  } else {
    tool.value = 'look';
  }
}

const MODES: readonly (readonly [Mode, string, string, string])[] = [
  ['look', '◉', 'Look', 'Look at the vessels from all sides'],
  ['trace', '✎', 'Trace', 'Trace vessels by clicks (t)'],
  ['measure', '⟷', 'Measure', 'Measure the picked vessel (m)'],
  ['report', '▤', 'Report', 'Findings on all vessels, to copy and save (e)'],
];

export function ModeButtons() {
  if (!hasVolume.value) {
    return null;
  }
  return (
    <fieldset class="segments modes">
      <legend class="hidden-words">Mode</legend>
      {MODES.map(([name, icon, words, title]) => (
        <button
          key={name}
          type="button"
          aria-pressed={mode() === name}
          title={title}
          onClick={() => change(name)}
        >
          <span aria-hidden="true">{icon}</span> <span class="words">{words}</span>
        </button>
      ))}
    </fieldset>
  );
}
