/** The windows to choose: presets, and those that the user named. */
import { useState } from 'preact/hooks';
import { choosePreset, chooseWindow } from '../state/actions';
import { dropWindow, keepWindow, LONGEST_NAME, ownWindows } from '../state/own-windows';
import * as store from '../state/store';

const CUSTOM = 'custom';
const KEEP = 'keep';
const DROP = 'drop';
const OWN = 'own ';

export function WindowPresets() {
  const [isNaming, setNaming] = useState(false);
  const presets = store.report.value?.windows?.presets ?? [];
  const own = ownWindows.value;
  const isNow = ({ window }: { readonly window: readonly [number, number] }) =>
    window.every((value, n) => value === store.window_.value[n]);
  const preset = presets.findIndex(isNow);
  const mine = own.find(isNow);
  const choose = (value: string) => {
    if (value === KEEP) {
      setNaming(true);
    } else if (value === DROP) {
      dropWindow(mine?.name ?? '');
    } else if (value.startsWith(OWN)) {
      chooseWindow(own.find(({ name }) => OWN + name === value)?.window);
    } else {
      choosePreset(Number(value));
    }
  };
  if (isNaming) {
    return <WindowName end={() => setNaming(false)} />;
  }
  return (
    <label>
      <span class="hidden-words">Window preset</span>
      <select
        title="From the data, the lumen is light grey and much darker tissue, such as an aneurysm sac, black: 9 shows it"
        value={mine ? OWN + mine.name : preset < 0 ? CUSTOM : String(preset)}
        onChange={(event) => choose(event.currentTarget.value)}
      >
        <option value={CUSTOM} disabled>
          Custom window
        </option>
        {presets.map(({ name, words }, number) => (
          <option key={name} value={String(number)}>{`${words} (${number + 1})`}</option>
        ))}
        {own.map(({ name }) => (
          <option key={name} value={OWN + name}>
            {name}
          </option>
        ))}
        {mine ? (
          <option value={DROP}>{`Delete ${mine.name}`}</option>
        ) : (
          <option value={KEEP}>Keep this window …</option>
        )}
      </select>
    </label>
  );
}

function WindowName({ end }: { readonly end: () => void }) {
  return (
    <input
      class="window-name"
      aria-label="Name of this window"
      placeholder="Name, then Enter"
      maxLength={LONGEST_NAME}
      ref={(field) => field?.focus()}
      onBlur={end}
      onKeyDown={(event) => {
        if (event.key === 'Enter') {
          keepWindow(event.currentTarget.value, store.window_.value);
        }
        if (event.key === 'Enter' || event.key === 'Escape') {
          event.stopPropagation();
          end();
        }
      }}
    />
  );
}
