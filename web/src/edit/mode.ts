/** While tracing, the page shows three slices and a maximum intensity projection. */

import { batch, effect, untracked } from '@preact/signals';
import type { SettingValue } from '../core/messages';
import { setSetting, settingOf } from '../state/actions';
import { moveTo } from '../state/cross-hair';
import { editQueue } from '../state/edit-queue';
import { openList, showAllViews } from '../state/panels';
import * as store from '../state/store';
import { setLayout } from '../state/store';
import { isTracing } from '../state/tool';
import { endVessel } from './pointing';

interface Kept {
  readonly layout: store.Layout;
  readonly context: SettingValue;
}

/** The layout before tracing; null while no tool is active. */
let before: Kept | null = null;

/** Shows the layout of a tool, and restores the previous one afterwards. */
export function followTool(): () => void {
  return effect(() => {
    const isOn = isTracing();
    batch(() => {
      if (isOn && !before) {
        before = { layout: store.layout.peek(), context: peekContext() };
        show({ layout: 'four', context: 'mip' });
        showAllViews();
        openList();
      } else if (!isOn && before) {
        endVessel();
        editQueue.forgetRefusal();
        // Restore only what the user has not changed meanwhile.
        const isOurs = store.layout.peek() === 'four' && peekContext() === 'mip';
        if (isOurs) {
          show(before);
        }
        // A maximised slice would hide the traced vessel.
        showAllViews();
        before = null;
        untracked(() => moveTo(store.pickedPlace.value));
      }
    });
  });
}

function peekContext(): SettingValue {
  return untracked(() => settingOf('context'));
}

function show({ layout, context }: Kept): void {
  setLayout(layout);
  untracked(() => setSetting('context', context));
}
