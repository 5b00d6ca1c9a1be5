/** Runs the real engine, as the worker of the page does. */
import { readFileSync } from 'node:fs';
import { vi } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Asked, Edit, Edited, Progress, Report, Vector, VesselDocument } from '../src/core/messages';
import { Engine, initSync } from '../src/core/pkg/lumencut.js';
import { ask, refuseStopped } from '../src/worker/answers';
import { askWithFiles } from '../src/worker/masks';

// The page fetches the module for volumes from its server.
vi.stubGlobal('fetch', async (address: URL) => {
  return new Response(readFileSync(address), { headers: { 'Content-Type': 'application/wasm' } });
});

initSync({ module: readFileSync(new URL('../src/core/pkg/lumencut_bg.wasm', import.meta.url)) });

export interface Opened {
  readonly engine: Asked;
  readonly report: () => Report;
  readonly cancel: () => void;
}

export async function opened(phantom: string, scale = 1): Promise<Opened> {
  const module = await Engine.open('cpu');
  module.open_phantom(phantom, scale);
  let cancelled = new AbortController();
  const engine: Asked = {
    ask: async (name, message, attachments = {}) => {
      const { signal } = cancelled;
      // As in the queue of the worker, work starts only after the request has returned.
      await Promise.resolve();
      try {
        refuseStopped(name, signal);
        return await askWithFiles(module, name, message, { attachments, signal });
      } catch (error) {
        throw Failure.of(error);
      }
    },
  };
  const cancel = () => {
    cancelled.abort();
    cancelled = new AbortController();
  };
  return { engine, report: () => ask(module, 'report', null), cancel };
}

export const EMPTY: VesselDocument = {
  vessels: [],
  stoppers: [],
  bridge: false,
  bone_hidden: false,
  dark: false,
};

export const edited = async (engine: Asked, edit: Edit, document = EMPTY): Promise<Edited> =>
  (await engine.ask('edit', { document, edit, bridging: false })).edited;

export const lineOf = ({ document }: Edited, n = 0): number => document.vessels[n]?.line ?? -1;

export const unheard = (_: Progress): void => {};

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
