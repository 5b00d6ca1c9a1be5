/** Changes between tracing of vessels and of dark lumens; context and window follow. */
import { batch } from '@preact/signals';
import type { Histogram, Settings } from '../core/messages';
import type { Window } from '../core/plain';
import { chooseRegion } from '../state/looks';
import * as store from '../state/store';
import { commit, isDone } from './committing';
import { showProjection } from './mode';

const REGION = 'airways';

/** Settings and window of a scan, which its histogram identifies, before dark lumens were traced. */
let before: {
  readonly histogram: Histogram | null;
  readonly settings: Settings;
  readonly window: Window;
} | null = null;

export async function traceDark(dark: boolean): Promise<boolean> {
  const isSet = await isDone(commit({ kind: 'set_dark', dark }));
  if (isSet) {
    batch(() => {
      if (dark) {
        before = {
          histogram: store.histogram.peek(),
          settings: store.settings.peek(),
          window: store.window_.peek(),
        };
        chooseRegion(REGION);
      } else if (before?.histogram === store.histogram.peek()) {
        store.putBackSettings(before.settings, before.window);
      }
      showProjection(dark);
    });
  }
  return isSet;
}
