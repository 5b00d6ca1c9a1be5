/** Menus: moves them into the window, and closes them after a choice (unless it `stays`), on Escape, and on a press elsewhere. */
import type { RefObject, TargetedEvent } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

export function useClosing(): RefObject<HTMLDetailsElement | null> {
  const menu = useRef<HTMLDetailsElement>(null);
  useEffect(() => {
    const ended = new AbortController();
    const { signal } = ended;
    const close = () => menu.current?.removeAttribute('open');
    const pressed = ({ target }: Event) => {
      if (!menu.current?.contains(target as Node)) {
        close();
      }
    };
    const keyed = (event: KeyboardEvent) => {
      if (event.key === 'Escape' && menu.current?.open) {
        event.stopPropagation();
        close();
        menu.current.querySelector('summary')?.focus();
      }
    };
    const clicked = ({ target }: Event) => {
      if ((target as Element).closest('button:not(.stays)')) {
        close();
      }
    };
    document.addEventListener('pointerdown', pressed, { signal, capture: true });
    document.addEventListener('keydown', keyed, { signal, capture: true });
    menu.current?.addEventListener('click', clicked, { signal });
    return () => ended.abort();
  }, []);
  return menu;
}

const EDGE = 8;

/** Moves an opened menu so that it lies within the window. */
export function keepWithin({ currentTarget: menu }: TargetedEvent<HTMLDetailsElement>): void {
  const body = menu.querySelector<HTMLElement>('.menu-body');
  if (menu.open && body) {
    body.style.left = '0';
    const beyond = body.getBoundingClientRect().right + EDGE - window.innerWidth;
    body.style.left = `${-Math.max(beyond, 0)}px`;
  }
}
