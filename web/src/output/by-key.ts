/** Saves the session or the report by a keyboard shortcut. */
import { Failure } from '../core/failure';
import type { Action } from '../input/bindings';
import { problem, report } from '../state/store';
import { saveReport } from './report';
import { saveSession } from './session';

/** Saves the session or the report, if the action asks for it. Returns whether it does. */
export function saveByKey(action: Action): boolean {
  const save = { 'save session': saveSession, 'save report': saveReport }[action as string];
  if (save && report.value) {
    save().catch((error: unknown) => {
      problem.value = Failure.of(error);
    });
  }
  return save !== undefined;
}
