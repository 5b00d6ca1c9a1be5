/** Buttons that switch between the modes Look, Trace, Measure and Report. */

import { toggleLayout } from '../state/actions';
import { kind } from '../state/kind';
import { hasVolume, layout } from '../state/store';
import { isTracing, takeTool } from '../state/tool';

type Mode = 'look' | 'trace' | 'measure' | 'report';

function mode(): Mode {
  if (isTracing()) {
    return 'trace';
  }
  const shown = layout.value;
  return shown === 'measure' || shown === 'report' ? shown : 'look';
}

/** Switches the mode. A second press keeps the mode, because users may double-click; "Look" leaves it. */
function change(to: Mode): void {
  const from = mode();
  if (from === to) {
    return;
  }
  if (to === 'trace') {
    takeTool('trace');
  } else if (to === 'measure' || to === 'report') {
    toggleLayout(to);
  } else if (from === 'measure' || from === 'report') {
    toggleLayout(from);
  } else {
    takeTool('look');
  }
}

const MODES: readonly (readonly [Mode, string, string, string])[] = [
  ['look', '◉', 'Look', 'Look at the vessels from all sides'],
  ['trace', '✎', 'Trace', ''],
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
          title={name === 'trace' ? `Trace ${kind.value.several} by clicks (t)` : title}
          onClick={() => change(name)}
        >
          <span aria-hidden="true">{icon}</span> <span class="words">{words}</span>
        </button>
      ))}
    </fieldset>
  );
}
