/** Windows that the user named. The browser's storage keeps them for all scans; they hold no patient data. */
import { signal } from '@preact/signals';
import type { Window } from '../core/messages';

export interface OwnWindow {
  readonly name: string;
  readonly window: Window;
}

const KEY = 'lumencut.windows';
const MOST_WINDOWS = 20;
export const LONGEST_NAME = 40;

export const ownWindows = signal<readonly OwnWindow[]>(stored());

/** Keeps a window under a name, in place of an earlier one of that name; an empty name keeps nothing. */
export function keepWindow(name: string, window: Window): void {
  const named = name.trim().slice(0, LONGEST_NAME);
  if (named) {
    write([...others(named), { name: named, window }].slice(-MOST_WINDOWS));
  }
}

export function dropWindow(name: string): void {
  write(others(name));
}

const others = (name: string): OwnWindow[] => ownWindows.value.filter((own) => own.name !== name);

function write(windows: readonly OwnWindow[]): void {
  ownWindows.value = windows;
  try {
    localStorage.setItem(KEY, JSON.stringify(windows));
  } catch {
    // Without storage, the windows last until the tab closes.
  }
}

/** The stored windows. Others may have written there, so anything else is ignored. */
function stored(): readonly OwnWindow[] {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(KEY) ?? '[]');
    return Array.isArray(found) ? found.filter(isOwn).slice(-MOST_WINDOWS) : [];
  } catch {
    return [];
  }
}

function isOwn(found: Partial<OwnWindow> | null): found is OwnWindow {
  const window: unknown = found?.window;
  return (
    typeof found?.name === 'string' &&
    found.name.length <= LONGEST_NAME &&
    Array.isArray(window) &&
    window.length === 2 &&
    window.every(Number.isFinite) &&
    window[1] > 0
  );
}
