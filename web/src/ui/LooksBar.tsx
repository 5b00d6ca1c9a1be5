/** Display controls: look, region preset, margin around vessels, and edge lines. */
import type { LookRow } from '../core/messages';
import { hideBone } from '../edit/vessels';
import { setSetting, settingOf } from '../state/actions';
import { document_ } from '../state/history';
import {
  chooseLines,
  chooseLook,
  chooseRegion,
  chooseStent,
  chosenLook,
  chosenRegion,
  isOffered,
  isStentShown,
  type Lines,
  lines,
  mayHaveBone,
  mayHoldStents,
  STENT_LOOK,
} from '../state/looks';
import { hasTree, hasVolume, started } from '../state/store';
import { isTracing } from '../state/tool';

const MAX_MARGIN_MM = 30;
const LINES: readonly (readonly [Lines, string])[] = [
  ['none', 'No lines'],
  ['near', 'Lines near'],
  ['all', 'All lines'],
];

export function LooksBar() {
  // While tracing, the view always shows a projection, to which looks do not apply.
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
        {mayHoldStents.value && <StentButton />}
      </fieldset>
      {mayHaveBone.value && <BoneButton />}
      {hasTree.value && <RegionChoice />}
      <Reach />
      {hasTree.value && <LinesChoice />}
    </div>
  );
}

/** Button for stents: selects a look together with its window. */
function StentButton() {
  return (
    <button
      type="button"
      aria-pressed={isStentShown.value}
      title="Shows the cut in a wide window, which separates stent struts from the lumen"
      onClick={chooseStent}
    >
      Stent
    </button>
  );
}

function BoneButton() {
  const isHidden = document_.value.bone_hidden;
  return (
    <button
      type="button"
      aria-pressed={isHidden}
      title="Hides bone around the cut and in MIPs; slices and measurements keep it. The first use searches for all vessels, to keep them"
      onClick={() => void hideBone(!isHidden)}
    >
      Hide bone
    </button>
  );
}

function RegionChoice() {
  const regions = started.value?.regions ?? [];
  return (
    <label title="Preset for a body region or type of scan: look, window and slab">
      <span class="hidden-words">Look by region</span>
      <select value={chosenRegion.value ?? ''} onChange={(event) => chooseRegion(event.currentTarget.value)}>
        <option value="">By region</option>
        {regions.map(({ name, words, sentence }) => (
          <option key={name} value={name} title={`Shows ${sentence}`}>
            {words}
          </option>
        ))}
      </select>
    </label>
  );
}

function LookButton({ look }: { readonly look: LookRow }) {
  return (
    <button
      type="button"
      aria-pressed={chosenLook.value === look.name && !(look.name === STENT_LOOK && isStentShown.value)}
      disabled={!isOffered(look)}
      title={isOffered(look) ? `Shows ${look.sentence}` : `Shows ${look.sentence}; needs a vessel`}
      onClick={() => chooseLook(look)}
    >
      {look.words}
    </button>
  );
}

/** Slider for the margin around the vessels in which the cut is fully visible. */
function Reach() {
  const focus = settingOf('focus');
  const [margin, fade] = Array.isArray(focus) ? focus.map(Number) : [-1, 0];
  if (!hasTree.value || margin === undefined || margin < 0) {
    return null;
  }
  return (
    <label title="Width of the cut shown around each vessel">
      <span class="hidden-words">Margin around the vessels (mm)</span>
      <input
        type="range"
        min="0"
        max={MAX_MARGIN_MM}
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
    <label title="Lines mark where the depth of the cut jumps">
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
