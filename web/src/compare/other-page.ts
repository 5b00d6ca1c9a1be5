/** The connection of the main page to its companion, the page with the other scan. */
import { computed, effect, untracked } from '@preact/signals';
import { proxy, type Remote, windowEndpoint, wrap } from 'comlink';
import { Failure } from '../core/failure';
import { Latest } from '../core/latest';
import type { Seen } from '../core/linked';
import type { Vector } from '../core/messages';
import { followSeen, seenNow, setOperated, takeSeen, viewSize } from '../state/linked-view';
import * as store from '../state/store';
import {
  across,
  beginScans,
  links,
  motion,
  otherScan,
  pairs,
  setPlaced,
  showBeside,
  takeOther,
} from '../state/two-scans';
import { engine } from '../worker/engine';
import type { Companion } from './companion';
import { followOperation } from './operation';

let page: Remote<Companion> | null = null;
let ends: readonly (() => void)[] = [];
/** Counts the views that this page imposed on the other one. Older views of the other page are ignored. */
let turn = 0;

const volume = computed(() => store.report.value?.volume);
const otherCount = computed(() => otherScan.value?.count);
const viewSizes = computed(() => `${viewSize.value} ${otherScan.value?.size}`);
const latest = new Latest();

/** The other page. Throws `Failure` if none is open. */
export function otherPage(): Remote<Companion> {
  if (!page) {
    throw new Failure('measuring', 'scans to compare', 'one scan', 'a second scan next to it');
  }
  return page;
}

export async function connect(to: Window): Promise<void> {
  disconnect();
  const made = wrap<Companion>(windowEndpoint(to, self, window.location.origin));
  page = made;
  ends = [
    followOperation(),
    followSeen(send),
    // A new motion between the scans, a new link or a resized view brings the other view in line.
    effect(() => {
      const isLinked = motion.value && links.value.length > 0 && viewSizes.value !== '';
      untracked(() => isLinked && impose());
    }),
    effect(() => {
      if (volume.value !== undefined) {
        untracked(beginScans);
      }
    }),
    effect(() => {
      const [corners, count, given] = [volume.value?.corners, otherCount.value, pairs.value];
      if (corners && count !== undefined) {
        untracked(() => place(corners, given));
      }
    }),
  ];
  await made.follow(proxy({ seen: hear, scan: takeOther, left }));
}

export function disconnect(): void {
  for (const end of ends) {
    end();
  }
  ends = [];
  page = null;
}

/** Asks for the motion to the other scan by its position, or by pairs. */
function place(corners: readonly Vector[], given: typeof pairs.value): void {
  const other = otherScan.value?.corners ?? [];
  latest.run(async () => {
    try {
      setPlaced(await engine.ask('motion_between', { corners: [corners, other], pairs: given }));
    } catch (error) {
      store.showProblem(error);
    }
  });
}

function send(seen: Seen): void {
  const there = untracked(() => across(seen, false));
  if (otherScan.peek() && Object.keys(there).length > 0) {
    void page?.show(there, turn);
  }
}

function impose(): void {
  turn += 1;
  setOperated(true);
  send(seenNow());
}

function hear(seen: Seen, itsTurn: number): void {
  if (itsTurn === turn) {
    takeSeen(across(seen, true));
  }
}

/** Closes the other page; if a scan is open there, after the user has agreed to lose unsaved work. */
export function closeOther(): void {
  if (page && otherScan.value) {
    page.leave().catch(store.showProblem);
  } else {
    left();
  }
}

function left(): void {
  disconnect();
  showBeside(false);
}
