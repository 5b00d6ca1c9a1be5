/** Starts all effects that update the page when the document changes. */
import { followPointer } from './drawing';
import { followLines } from './lines';
import { followTool } from './mode';
import { followDocument } from './shown';
import { followFacts } from './tidying';
import { followWhole } from './whole-shown';

export function followEdits(): void {
  followDocument();
  followLines();
  followFacts();
  followPointer();
  followWhole();
  followTool();
}
