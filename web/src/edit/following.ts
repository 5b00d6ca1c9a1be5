/** Starts all effects that update the page when the document changes. */
import type { Asked } from '../core/asked';
import { followPointer } from './drawing';
import { followLines } from './lines';
import { followTool } from './mode';
import { followDocument } from './shown';
import { followFacts } from './tidying';
import { followWhole } from './whole-shown';

export function followEdits(engine: Asked): void {
  followDocument(engine);
  followLines(engine);
  followFacts(engine);
  followPointer(engine);
  followWhole(engine);
  followTool();
}
