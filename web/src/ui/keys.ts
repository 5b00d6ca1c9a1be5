/** Handles keys for the whole page, except those that a text field needs. */

import { performAny } from '../edit/performing';
import { type Action, actionOfKey, keyOf } from '../input/bindings';
import { focusSoon } from '../input/focus';
import { saveByKey } from '../output/save-actions';
import { layout } from '../state/store';
import { isTracing } from '../state/tool';

export function listenToKeys(): void {
  window.addEventListener('keydown', (event) => {
    const { target } = event;
    const key = keyOf(event);
    const action = actionOfKey(key, event.ctrlKey || event.metaKey ? 'Ctrl' : '');
    if (!action || event.altKey || isPress(target, key) || (isField(target) && !isOfAll(action))) {
      return;
    }
    event.preventDefault();
    if (!saveByKey(action)) {
      performAny(action);
      follow(action);
    }
  });
}

const isOfAll = (action: Action): boolean => ['cancel', 'save session', 'save report'].includes(action);

/** Moves the focus to the view that an action opened, so that it receives the next keys. */
function follow(action: Action): void {
  if (action === 'trace' && isTracing()) {
    focusSoon('[data-testid="coronal"]');
  } else if (action === 'measure' && layout.value === 'measure') {
    focusSoon('[data-testid="numbers"] button');
  } else if (action === 'report' && layout.value === 'report') {
    focusSoon('[data-testid="findings"] button');
  }
}

function isPress(target: EventTarget | null, key: string): boolean {
  const isPressed =
    target instanceof HTMLButtonElement ||
    target instanceof HTMLInputElement ||
    (target instanceof HTMLElement && target.tagName === 'SUMMARY');
  return isPressed && (key === ' ' || key === 'Enter');
}

/** Whether an element takes text: an input, but not a checkbox, radio button or read-only name. */
function isField(target: EventTarget | null): boolean {
  const isBox = target instanceof HTMLInputElement && ['checkbox', 'radio'].includes(target.type);
  return (
    (target instanceof HTMLInputElement && !isBox && !target.readOnly) || target instanceof HTMLSelectElement
  );
}
