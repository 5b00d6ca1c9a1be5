/** Starts all effects that update the page when the document changes. */

import { followLines } from '../state/lines';
import { followDocument } from '../state/shown';
import { followFacts } from '../state/tidying';
import { followTool } from './mode';
import { followPointer, followWhole } from './previews';

export function followEdits(): void {
  followDocument();
  followLines();
  followFacts();
  followPointer();
  followWhole();
  followTool();
}
