/** Saves by a button or a key; if saving fails, the page shows why. */
import type { Action } from '../input/bindings';
import { report, showProblem } from '../state/store';
import { saveReport } from './report';
import { saveSession } from './session';

/** Saves the session or the report, if the action asks for it. Returns whether it does. */
export function saveByKey(action: Action): boolean {
  const save = { 'save session': saveSession, 'save report': saveReport }[action as string];
  if (save && report.value) {
    attempt(save);
  }
  return save !== undefined;
}

export function attempt(save: () => Promise<void>): void {
  save().catch(showProblem);
}
