/** Menus that open near the right edge of the window. */
import type { TargetedEvent } from 'preact';

/** How far a menu stays from the edge (CSS pixels). */
const EDGE = 8;

/** Moves the body of a menu that was opened to the left, as far as it would reach beyond the window. */
export function keepWithin({ currentTarget: menu }: TargetedEvent<HTMLDetailsElement>): void {
  const body = menu.querySelector<HTMLElement>('.menu-body');
  if (menu.open && body) {
    body.style.left = '0';
    const beyond = body.getBoundingClientRect().right + EDGE - window.innerWidth;
    body.style.left = `${-Math.max(beyond, 0)}px`;
  }
}
