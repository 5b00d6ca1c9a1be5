import { tracedSummary } from '../state/drawing';
import { LineDoubts } from './LineDoubts';

export function TracedSummary() {
  const summary = tracedSummary.value;
  return (
    summary && (
      <LineDoubts key={summary.words} id={summary.vessel} words={summary.words} doubts={summary.doubts} />
    )
  );
}
