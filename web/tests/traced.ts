/** The engine itself, as the page's worker has it, with the room that traces. */
import { readFileSync } from 'node:fs';
import type { Edit, Edited, VesselDocument } from '../src/core/edits';
import { Failure } from '../src/core/failure';
import type { Progress, Report, Vector } from '../src/core/messages';
import { Engine, initSync } from '../src/core/pkg/lumencut.js';
import { TracingHost } from '../src/worker/tracing-host';

initSync({ module: readFileSync(new URL('../src/core/pkg/lumencut_bg.wasm', import.meta.url)) });

export interface Opened {
  readonly engine: Engine;
  readonly tracing: TracingHost;
  readonly report: () => Report;
  /** Says stop to what was asked for until then. */
  readonly cancel: () => void;
}

/** An engine with a phantom open. */
export async function opened(phantom: string, scale = 1): Promise<Opened> {
  const engine = await Engine.open('cpu');
  engine.open_phantom(phantom, scale);
  const report = (): Report => JSON.parse(engine.report());
  let cancelled = new AbortController();
  const tracing = new TracingHost({
    run: async (work) => {
      // As in the queue, work begins once what asked for it has gone on.
      await Promise.resolve();
      try {
        return await work(engine);
      } catch (error) {
        throw Failure.of(error);
      }
    },
    signal: () => cancelled.signal,
    report,
  });
  const cancel = () => {
    cancelled.abort();
    cancelled = new AbortController();
  };
  return { engine, tracing, report, cancel };
}

/** A document without vessels. */
export const EMPTY: VesselDocument = { vessels: [], stoppers: [], bridge: false };

/** What comes of an edit of a document. */
export const edited = (tracing: TracingHost, edit: Edit, document = EMPTY): Promise<Edited> =>
  tracing.edit({ document, edit, bridging: false }, unheard, null);

/** The line of a vessel after an edit. */
export const lineOf = ({ document }: Edited, n = 0): number => document.vessels[n]?.line ?? -1;

/** Nobody listens. */
export const unheard = (_: Progress): void => {};

/** What a promise is refused with. */
export async function refusal(promise: Promise<unknown>): Promise<Failure> {
  try {
    await promise;
  } catch (error) {
    return Failure.of(error);
  }
  throw new Error('no refusal');
}

export function distance(a: Vector, b: Vector): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
