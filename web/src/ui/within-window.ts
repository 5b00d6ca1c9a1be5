/** Moves an opened menu so that it lies within the window. */
import type { TargetedEvent } from 'preact';

const EDGE = 8;

export function keepWithin({ currentTarget: menu }: TargetedEvent<HTMLDetailsElement>): void {
  const body = menu.querySelector<HTMLElement>('.menu-body');
  if (menu.open && body) {
    body.style.left = '0';
    const beyond = body.getBoundingClientRect().right + EDGE - window.innerWidth;
    body.style.left = `${-Math.max(beyond, 0)}px`;
  }
}
