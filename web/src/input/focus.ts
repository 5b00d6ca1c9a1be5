/** Moves the keyboard focus to a view that has just been opened by a key. */

/** How many frames to wait for the view to appear. */
const MOST_FRAMES = 30;

/** Focuses an element once it exists, unless the user moved the focus. */
export function focusSoon(selector: string): void {
  const before = document.activeElement;
  const look = (frames: number) => {
    const found = document.querySelector<HTMLElement>(selector);
    const isStill = document.activeElement === before || document.activeElement === document.body;
    if (found && isStill) {
      found.focus();
    } else if (isStill && frames < MOST_FRAMES) {
      requestAnimationFrame(() => look(frames + 1));
    }
  };
  requestAnimationFrame(() => look(0));
}
