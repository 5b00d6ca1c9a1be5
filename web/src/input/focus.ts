/** Where the focus goes by itself: a key that shows other views takes it to the one that is worked in next. */

/** A view that is shown is drawn after some frames; one that does not come is not waited for. */
const MOST_FRAMES = 30;

/** Moves the focus to what a selector finds, once it is there, unless the user moved it meanwhile. */
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
