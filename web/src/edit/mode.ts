/** While tracing, the page shows three slices and a projection: of the largest values, or of the smallest for dark lumens. */

import { batch, effect, untracked } from '@preact/signals';
import type { SettingValue } from '../core/messages';
import { setSetting, settingOf } from '../state/actions';
import { moveTo } from '../state/cross-hair';
import { editQueue } from '../state/edit-queue';
import { isDark } from '../state/kind';
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

/** The context that shows lumens while tracing. */
const projectionOf = (dark: boolean): string => (dark ? 'minip' : 'mip');

/** Shows the layout of a tool, and restores the previous one afterwards. */
export function followTool(): () => void {
  return effect(() => {
    const isOn = isTracing();
    batch(() => {
      if (isOn && !before) {
        before = { layout: store.layout.peek(), context: peekContext() };
        show({ layout: 'four', context: projectionOf(isDark.peek()) });
        showAllViews();
        openList();
      } else if (!isOn && before) {
        endVessel();
        editQueue.forgetRefusal();
        // Restore only what the user has not changed meanwhile.
        const isOurs = store.layout.peek() === 'four' && peekContext() === projectionOf(isDark.peek());
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

/** While tracing, shows the projection for such lumens; the present context returns afterwards. */
export function showProjection(dark: boolean): void {
  if (before) {
    before = { ...before, context: peekContext() };
    setSetting('context', projectionOf(dark));
  }
}

function peekContext(): SettingValue {
  return untracked(() => settingOf('context'));
}

function show({ layout, context }: Kept): void {
  setLayout(layout);
  untracked(() => setSetting('context', context));
}
