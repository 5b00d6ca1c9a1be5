/** Starts compute threads, if the browser allows workers to share memory. */
import { type Shared, useThreads } from '../core/module';

/** Most threads; more would not help, because memory bandwidth limits rendering. */
const MAX_THREADS = 16;

export const THREAD = 'thread';

/** Starts one thread per logical core; returns their number. */
export async function startThreads(shared: Shared): Promise<number> {
  const count = Math.min(navigator.hardwareConcurrency || 1, MAX_THREADS);
  if (!self.crossOriginIsolated || count < 2) {
    return 1;
  }
  await Promise.all(Array.from({ length: count }, () => startThread(shared)));
  useThreads(count);
  return count;
}

function startThread(shared: Shared): Promise<void> {
  // Threads use the same file as this worker, so that it is loaded and compiled only once.
  const worker = new Worker(self.location.href, { type: 'module', name: THREAD });
  return new Promise((resolve, reject) => {
    worker.onmessage = () => resolve();
    worker.onerror = (event) => reject(new Error(event.message || 'a worker did not start'));
    worker.postMessage(shared);
  });
}
