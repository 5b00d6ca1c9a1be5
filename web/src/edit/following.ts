/** Everything that follows the document of edits as long as the page is open. */
import type { Tracing } from '../core/tracing';
import { followPointer } from './drawing';
import { followLines } from './lines';
import { followTool } from './mode';
import { followDocument } from './shown';

export function followEdits(tracing: Tracing): void {
  followDocument(tracing);
  followLines(tracing);
  followPointer(tracing);
  followTool();
}
