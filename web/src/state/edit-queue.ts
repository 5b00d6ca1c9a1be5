/** The queue of edits. They run one after another; each becomes one undo step or changes nothing. */
import { batch, signal } from '@preact/signals';
import { Failure } from '../core/failure';
import type { AfterEdit, Edit, Progress } from '../core/messages';
import { placeCrossHair } from './cross-hair';
import type { Document } from './document';
import { change } from './history';
import { problem, progress } from './store';

/** What an edit does. `plain` edits run in the page, without the engine. */
export type EditKind = Edit['kind'] | 'plain';

/** During these edits, clicks set no points. */
const SEARCHES: readonly EditKind[] = ['add_branches', 'find_vessels', 'add_mask'];

/** The progress of an edit is shown only if the edit takes longer than this (ms). */
const SHOWN_AFTER = 250;

/** A longer search (ms) probably started in bone instead of a vessel, so the page asks the user. */
const ASKED_AFTER = 20_000;

/** A rejected edit; `bridge` repeats it and bridges gaps. */
export interface Refusal {
  readonly failure: Failure;
  readonly bridge: (() => void) | null;
}

export interface EditState {
  /** `stopping`: the running edit was dropped, and the next one waits until the engine has ended it. */
  readonly phase: 'idle' | 'waiting' | 'running' | 'stopping';
  readonly running: EditKind | null;
  readonly queued: readonly EditKind[];
  /** Whether the running search takes so long that the page asks the user. */
  readonly isLong: boolean;
  /** The edit that was rejected last, until the user tries something else. */
  readonly refusal: Refusal | null;
}

/** One undo step: its description, the new document, and what else happens with it. */
export interface Step<T> {
  readonly words: string;
  readonly after: Document;
  readonly result: T;
  readonly answer?: AfterEdit;
  readonly also?: () => void;
}

export type Work<T> = (onProgress: (progress: Progress) => void) => Promise<Step<T>> | Step<T>;

interface Entry {
  readonly kind: EditKind;
  readonly work: Work<unknown>;
  readonly bridge: (() => void) | null;
  readonly resolve: (result: unknown) => void;
  /** Whether the user stopped it or closed the study; its result is then ignored. */
  isDropped: boolean;
  isLong: boolean;
}

const IDLE: EditState = { phase: 'idle', running: null, queued: [], isLong: false, refusal: null };

/** The latest answer to an edit. It contains the tree, so the page need not request it again. */
export const answered = signal<AfterEdit | null>(null);

export function keepAnswer(answer: AfterEdit | undefined): void {
  answered.value = answer ?? answered.value;
}

export class EditQueue {
  private readonly entries: Entry[] = [];
  private running: Entry | null = null;
  private isStarted = false;
  private readonly current = signal<EditState>(IDLE);

  /** A view that reads the state is drawn again when it changes. */
  get state(): EditState {
    return this.current.value;
  }

  get isBusy(): boolean {
    return this.state.phase !== 'idle';
  }

  get isSearching(): boolean {
    const { running } = this.state;
    return running !== null && SEARCHES.includes(running);
  }

  /** Runs the work after all edits before it. Returns its result, or null if it was not done. */
  add<T>(kind: EditKind, work: Work<T>, bridge: (() => void) | null = null): Promise<T | null> {
    return new Promise((resolve) => {
      const entry = { kind, work, bridge, isDropped: false, isLong: false };
      this.entries.push({ ...entry, resolve: resolve as Entry['resolve'] });
      this.publish();
      if (!this.isStarted) {
        this.isStarted = true;
        void this.runAll();
      }
    });
  }

  /** Drops all edits, as after a stop or for a new study. The engine may still have to end the running one. */
  drop(): void {
    const dropped = this.entries.splice(0);
    if (this.running) {
      this.running.isDropped = true;
    }
    this.publish({ refusal: null });
    for (const { resolve } of dropped) {
      resolve(null);
    }
  }

  goOnSearching(): void {
    this.setLong(this.running, false);
  }

  showRefusal(failure: Failure, bridge: (() => void) | null = null): void {
    this.publish({ refusal: { failure, bridge } });
    problem.value = failure;
    if (failure.place) {
      const { place: point, value } = failure;
      placeCrossHair({ point, value, vessel: null, arc_length: null }, 'turning');
    }
  }

  /** Closes the error message of a rejected edit when the user tries something else. */
  forgetRefusal(): void {
    const { refusal } = this.current.peek();
    if (refusal && problem.peek() === refusal.failure) {
      problem.value = null;
    }
    this.publish({ refusal: null });
  }

  private async runAll(): Promise<void> {
    // An edit begins only after the event that asked for it.
    await null;
    for (let entry = this.entries.shift(); entry; entry = this.entries.shift()) {
      await this.run(entry);
    }
    this.isStarted = false;
  }

  private async run(entry: Entry): Promise<void> {
    this.running = entry;
    this.forgetRefusal();
    const display = progressOf(entry);
    const asking = setTimeout(() => this.setLong(entry, entry.kind === 'add_branches'), ASKED_AFTER);
    try {
      const step = await entry.work(display.onProgress);
      if (entry.isDropped) {
        keepAnswer(step.answer);
      } else {
        record(step);
      }
      entry.resolve(entry.isDropped ? null : step.result);
    } catch (error) {
      entry.resolve(null);
      if (!entry.isDropped) {
        this.refuse(Failure.of(error), entry.bridge);
      }
    } finally {
      clearTimeout(asking);
      display.end();
      this.running = null;
      this.publish();
    }
  }

  /** A rejected edit drops those that wait behind it, because they may build on it. */
  private refuse(failure: Failure, bridge: (() => void) | null): void {
    this.drop();
    if (failure.kind !== 'interrupted') {
      this.showRefusal(failure, isGap(failure) ? bridge : null);
    }
  }

  private setLong(entry: Entry | null, isLong: boolean): void {
    if (entry) {
      entry.isLong = isLong;
      this.publish();
    }
  }

  private publish({ refusal }: Pick<EditState, 'refusal'> = this.current.peek()): void {
    const queued = this.entries.map(({ kind }) => kind);
    const { kind = null, isDropped = false, isLong = false } = this.running ?? {};
    const begun = isDropped ? 'stopping' : 'running';
    const phase = kind !== null ? begun : queued.length > 0 ? 'waiting' : 'idle';
    this.current.value = { phase, running: kind, queued, isLong, refusal };
  }
}

export const editQueue = new EditQueue();

export const isGap = (failure?: Failure): boolean => failure?.isMendedBy('bridge') ?? false;

/** Records the undo step; updates document and answer together. */
function record({ words, after, answer, also }: Step<unknown>): void {
  batch(() => {
    keepAnswer(answer);
    change(words, after);
    also?.();
  });
}

/** Shows the progress of an edit after a delay, even if no progress was reported. */
function progressOf(entry: Entry): { onProgress: (progress: Progress) => void; end: () => void } {
  let newest: Progress | null = null;
  let shown: Progress | null = null;
  let isDue = false;
  const show = () => {
    if (!entry.isDropped && isDue && newest) {
      shown = newest;
      progress.value = newest;
    }
  };
  const timer = setTimeout(() => {
    isDue = true;
    show();
  }, SHOWN_AFTER);
  const onProgress = (report: Progress) => {
    newest = report;
    show();
  };
  // Progress reports may arrive after the edit has ended; ignore them.
  const end = () => {
    clearTimeout(timer);
    isDue = false;
    progress.value = progress.peek() === shown ? null : progress.peek();
  };
  return { onProgress, end };
}
