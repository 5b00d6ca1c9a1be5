/** The look focus: the cut around the vessels amid the body, with how far it reaches. */
import { setSetting, settingOf, toggleFocus } from '../state/actions';
import { hasTree, hasVolume } from '../state/store';

/** The widest margin that the slider offers (mm). */
const WIDEST = 30;

export function FocusControl() {
  if (!hasTree.value || !hasVolume.value) {
    return null;
  }
  const focus = settingOf('focus');
  const [margin, fade] = Array.isArray(focus) ? focus.map(Number) : [0, 0];
  return (
    <>
      <button
        type="button"
        class="tool"
        aria-pressed={focus !== null}
        onClick={toggleFocus}
        title="Show the cut around the vessels amid the body"
      >
        Focus
      </button>
      {focus !== null && (
        <label>
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
      )}
    </>
  );
}
