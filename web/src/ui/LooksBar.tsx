/** How vessels and body are shown: the looks, how far the cut reaches around the vessels, and the lines where it leaps. */
import type { LookRow } from '../core/messages';
import { isTracing } from '../edit/mode';
import { setSetting, settingOf } from '../state/actions';
import {
  chooseLines,
  chooseLook,
  chooseStent,
  chosenLook,
  isOffered,
  isStentShown,
  type Lines,
  lines,
  STENT_LOOK,
} from '../state/looks';
import { hasTree, hasVolume, started } from '../state/store';

/** The widest margin that the slider offers (mm). */
const WIDEST = 30;
const LINES: readonly (readonly [Lines, string])[] = [
  ['none', 'No lines'],
  ['near', 'Lines near vessels'],
  ['all', 'All lines'],
];

export function LooksBar() {
  // While vessels are traced the view is a projection, whatever was chosen.
  if (!hasVolume.value || isTracing()) {
    return null;
  }
  return (
    <div class="looks">
      <fieldset class="segments">
        <legend class="hidden-words">Look</legend>
        {(started.value?.looks ?? []).map((look) => (
          <LookButton key={look.name} look={look} />
        ))}
        {hasTree.value && <StentButton />}
      </fieldset>
      <Reach />
      {hasTree.value && <LinesChoice />}
    </div>
  );
}

/** The cut through the vessels in the window for stents: the one look that also chooses a window. */
function StentButton() {
  return (
    <button
      type="button"
      aria-pressed={isStentShown.value}
      title="Shows the cut through the vessels in a wide window: the struts of a stent stand apart from the lumen"
      onClick={chooseStent}
    >
      Stent
    </button>
  );
}

function LookButton({ look }: { readonly look: LookRow }) {
  return (
    <button
      type="button"
      aria-pressed={chosenLook.value === look.name && !(look.name === STENT_LOOK && isStentShown.value)}
      disabled={!isOffered(look)}
      title={isOffered(look) ? `Shows ${look.sentence}` : `Shows ${look.sentence}: there are no vessels yet`}
      onClick={() => chooseLook(look)}
    >
      {look.words}
    </button>
  );
}

/** How far around the vessels all of the cut is shown, where it fades into the body. */
function Reach() {
  const focus = settingOf('focus');
  const [margin, fade] = Array.isArray(focus) ? focus.map(Number) : [-1, 0];
  if (!hasTree.value || margin === undefined || margin < 0) {
    return null;
  }
  return (
    <label title="How far around the vessels the cut is shown">
      <span class="hidden-words">Margin around the vessels (mm)</span>
      <input
        type="range"
        min="0"
        max={WIDEST}
        step="0.5"
        value={margin}
        onInput={(event) => setSetting('focus', [Number(event.currentTarget.value), fade ?? 0])}
      />
      {margin} mm
    </label>
  );
}

function LinesChoice() {
  return (
    <label title="Where the depth of the cut leaps, lines can mark it">
      <span class="hidden-words">Lines</span>
      <select value={lines.value} onChange={(event) => chooseLines(event.currentTarget.value as Lines)}>
        {LINES.map(([name, words]) => (
          <option key={name} value={name}>
            {words}
          </option>
        ))}
      </select>
    </label>
  );
}
