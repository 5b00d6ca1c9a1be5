/** Traces the whole vessel at one clicked point, after Enter, a double click or a button. */
import type { Edited } from '../core/messages';
import { editQueue } from '../state/edit-queue';
import { tool } from '../state/tool';
import { commit } from './committing';
import { first, isDrawing } from './drawing';
import { endVessel } from './pointing';
import { toPick } from './shown';
import { only } from './whole-shown';

/** Returns whether there was a point. If no vessel is found but a second point could help, the point stays. */
export function takeWhole(): boolean {
  const click = only.value;
  if (click) {
    endVessel();
    const then = ({ added: [id] }: Edited) => {
      toPick.value = id ?? toPick.value;
    };
    void commit({ kind: 'add_whole_vessel', click }, { then }).then((answer) => {
      const isLeft = answer === null && editQueue.state.refusal?.failure.advice !== '';
      first.value = isLeft && !isDrawing.value && tool.value === 'trace' ? click : first.value;
    });
  }
  return click !== null;
}
