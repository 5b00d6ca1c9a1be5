/** While a vessel is traced the page shows slices in all directions and the brightest values along each ray. */
import { batch, effect, signal, untracked } from '@preact/signals';
import type { SettingValue } from '../core/messages';
import { moveTo } from '../link/along';
import { setSetting, settingOf } from '../state/actions';
import * as store from '../state/store';
import { type Tool, tool } from '../state/tool';
import { forgetRefusal } from './committing';
import { openList } from './list-open';
import { endVessel } from './pointing';

/** The doubtful branch that was clicked, which is to be accepted or left out. */
export const chosenDoubt = signal<number | null>(null);

const TRACING: readonly Tool[] = ['trace', 'stopper', 'seed'];

/** Whether clicks set points, stoppers or the begin of a tree now. */
export const isTracing = (): boolean => TRACING.includes(tool.value);

interface Kept {
  readonly layout: store.Layout;
  readonly context: SettingValue;
}

/** What was shown before; null while no vessel is traced. */
let before: Kept | null = null;

/** Shows what a tool needs from now on, and afterwards what was shown before. */
export function followTool(): () => void {
  return effect(() => {
    const isOn = isTracing();
    batch(() => {
      if (isOn && !before) {
        before = { layout: store.layout.peek(), context: peekContext() };
        show({ layout: 'four', context: 'mip' });
        store.maximised.value = null;
        openList();
      } else if (!isOn && before) {
        endVessel();
        forgetRefusal();
        // What the user chose meanwhile stays.
        const isOurs = store.layout.peek() === 'four' && peekContext() === 'mip';
        if (isOurs) {
          show(before);
        }
        // A slice that was shown alone would hide the vessel that was traced.
        store.maximised.value = null;
        before = null;
        // The cross-hair was where the last click was.
        untracked(() => moveTo(store.pickedPlace.value));
      }
    });
  });
}

function peekContext(): SettingValue {
  return untracked(() => settingOf('context'));
}

function show({ layout, context }: Kept): void {
  store.layout.value = layout;
  untracked(() => setSetting('context', context));
}

/** Takes up a tool, or lays it down where it is in use. */
export function toggleTool(wanted: Tool): void {
  tool.value = tool.value === wanted ? 'look' : wanted;
}
