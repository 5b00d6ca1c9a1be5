/** Top bar: modes, vessel list, saving, window, layout and research. */

import { performAny } from '../edit/performing';
import { perform, showLayout, showOneIfNarrow } from '../state/actions';
import { redoWords, undoWords } from '../state/history';
import { isListOpen } from '../state/panels';
import * as store from '../state/store';
import { hasVolume } from '../state/store';
import { isBeside, isCompanion, showBeside } from '../state/two-scans';
import { close } from '../study/study';
import { leave } from '../study/unsaved';
import { ModeButtons } from './ModeButtons';
import { OpenMore } from './OpenButtons';
import { ResearchMenu } from './ResearchMenu';
import { SaveMenu } from './SaveMenu';
import { WindowStrip } from './WindowStrip';

const LAYOUT_NAMES: Readonly<Record<store.Layout, string>> = {
  one: 'One',
  two: 'Two',
  four: 'Four',
  strip: 'With strip',
  measure: 'Measure',
  report: 'Report',
};

export function Toolbar() {
  return (
    <header class="toolbar">
      {!isCompanion.value && <strong class="brand">Lumencut</strong>}
      <ModeButtons />
      <ListButton />
      <SaveMenu />
      <WindowStrip />
      <UndoButtons />
      <LayoutChoice />
      {!isCompanion.value && <ResearchMenu />}
      <span class="spring" />
      <OpenMore />
      {!isCompanion.value && <OfMainPage />}
    </header>
  );
}

/** Buttons that the page with the other scan does not repeat. */
function OfMainPage() {
  return (
    <>
      <button type="button" onClick={() => perform('help')} aria-label="Keys and mouse">
        ?
      </button>
      <button type="button" onClick={() => void leave(() => close())} aria-label="Close the scan">
        Close
      </button>
    </>
  );
}

/** The choice that shows another scan next to the open one; the layout of each stays free. */
const BESIDE = 'beside';

function choose(select: HTMLSelectElement): void {
  if (select.value === BESIDE) {
    select.value = store.layout.value;
    showBeside(true);
    showOneIfNarrow(window.innerWidth / 2);
  } else {
    showLayout(select.value as store.Layout);
  }
}

function LayoutChoice() {
  return (
    <label title="Which views are shown">
      <span class="hidden-words">Layout</span>
      <select value={store.layout.value} onChange={({ currentTarget }) => choose(currentTarget)}>
        {store.LAYOUTS.map((name) => (
          <option key={name} value={name}>
            {LAYOUT_NAMES[name]}
          </option>
        ))}
        {hasVolume.value && !isBeside.value && !isCompanion.value && (
          <option value={BESIDE}>Two scans …</option>
        )}
      </select>
    </label>
  );
}

function ListButton() {
  return store.hasVolume.value ? (
    <button
      type="button"
      class="tool"
      aria-pressed={isListOpen.value}
      onClick={() => performAny('vessels')}
      title="List of the vessels (v)"
    >
      Vessels
    </button>
  ) : null;
}

function UndoButtons() {
  if (!hasVolume.value) {
    return null;
  }
  const [back, forth] = [undoWords.value, redoWords.value];
  return (
    <span class="undo">
      <button
        type="button"
        aria-label="Undo"
        disabled={back === null}
        title={back ? `Undo: ${back} (Ctrl+z)` : 'Nothing to undo'}
        onClick={() => performAny('undo')}
      >
        ↶
      </button>
      <button
        type="button"
        aria-label="Redo"
        disabled={forth === null}
        title={forth ? `Redo: ${forth} (Ctrl+Shift+z)` : 'Nothing to redo'}
        onClick={() => performAny('redo')}
      >
        ↷
      </button>
    </span>
  );
}
