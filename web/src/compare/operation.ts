/** Notices that the user operates this page, which then leads the linked views. */
import { setOperated } from '../state/linked-view';

const INPUT = ['pointerdown', 'pointermove', 'wheel', 'keydown'] as const;

export function followOperation(): () => void {
  const ended = new AbortController();
  for (const kind of INPUT) {
    const how = { capture: true, passive: true, signal: ended.signal };
    window.addEventListener(kind, () => setOperated(true), how);
  }
  return () => ended.abort();
}
