/** Keeps menus within the window. */
import type { TargetedEvent } from 'preact';

/** Distance from the edge (CSS pixels). */
const EDGE = 8;

/** Shifts an open menu left as far as it exceeds the window. */
export function keepWithin({ currentTarget: menu }: TargetedEvent<HTMLDetailsElement>): void {
  const body = menu.querySelector<HTMLElement>('.menu-body');
  if (menu.open && body) {
    body.style.left = '0';
    const beyond = body.getBoundingClientRect().right + EDGE - window.innerWidth;
    body.style.left = `${-Math.max(beyond, 0)}px`;
  }
}
