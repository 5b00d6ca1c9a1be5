/** The keys of the page; those that are typed into a field belong to the field. */
import { engine } from '../core/shared';
import { perform } from '../state/actions';
import { actionOfKey } from './bindings';

export function listenToKeys(): void {
  window.addEventListener('keydown', (event) => {
    const isTyped = event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement;
    const isButton =
      event.target instanceof HTMLButtonElement && (event.key === ' ' || event.key === 'Enter');
    if (event.ctrlKey || event.metaKey || event.altKey || isButton || (isTyped && event.key !== 'Escape')) {
      return;
    }
    const action = actionOfKey(event.key);
    if (action) {
      event.preventDefault();
      perform(engine, action);
    }
  });
}
