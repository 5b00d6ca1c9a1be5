/** Starts the threads that compute, where the page may share memory between workers. */
import { type Shared, useThreads } from '../core/module';

/** The most threads: beyond them memory, not arithmetic, is what a picture waits for. */
const MOST = 16;

/** The name of a worker that is a thread. */
export const THREAD = 'thread';

/** Starts as many threads as the machine runs at once; tells how many compute. */
export async function startThreads(shared: Shared): Promise<number> {
  const count = Math.min(navigator.hardwareConcurrency || 1, MOST);
  if (!self.crossOriginIsolated || count < 2) {
    return 1;
  }
  await Promise.all(Array.from({ length: count }, () => startThread(shared)));
  useThreads(count);
  return count;
}

function startThread(shared: Shared): Promise<void> {
  // Its own file once more: what all of them need is loaded and compiled once.
  const worker = new Worker(self.location.href, { type: 'module', name: THREAD });
  return new Promise((resolve, reject) => {
    worker.onmessage = () => resolve();
    worker.onerror = (event) => reject(new Error(event.message || 'a worker did not start'));
    worker.postMessage(shared);
  });
}
