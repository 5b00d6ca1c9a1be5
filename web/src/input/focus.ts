/** Moves the focus to the view that a key opened. */

/** A view appears after some frames; stop waiting after these. */
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
