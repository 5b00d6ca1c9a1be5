/** Opens DICOM: one greyscale series from a folder, a zip archive or single files becomes one volume. */

import type { Judge } from '../../core/module';
import type { ReadScan } from '../../core/scan-study';
import { inOrder, type Source } from '../source';
import type { Steps } from '../steps';
import type { Sink } from '../volume-file';
import { unlikePairs } from './comparing';
import { type ExaminedFile, examine } from './headers';
import { asked, judged, type Plan } from './judging';
import { Recorder } from './records';
import { loadStack } from './stack';
import { studyOf } from './study';
import { withThumbnails } from './thumbnails';
import type { Wanted } from './wanted';

export { headOf } from './study';

export interface Series {
  readonly subject: string;
  readonly sources: readonly Source[];
  readonly wanted: Wanted;
}

export interface ReadSeries {
  readonly notes: readonly string[];
  readonly study: ReadScan | null;
}

export async function openDicom(series: Series, judge: Judge, sink: Sink, steps: Steps): Promise<ReadSeries> {
  const files = await examineAll(series.sources, judge, steps);
  const plan = await planned(series, judge, files);
  await loadStack(series.subject, plan, files, sink, steps);
  return { notes: plan.notes, study: await studyOf(plan, files) };
}

/** The plan of the volume. If the user must choose a series, the failure contains thumbnails. */
async function planned(series: Series, judge: Judge, files: readonly ExaminedFile[]): Promise<Plan> {
  try {
    const question = { ...series, files };
    const plan = judged(judge, question);
    const unlike = await unlikePairs(plan, files);
    return unlike.length > 0 ? judged(judge, { ...question, unlike }) : plan;
  } catch (error) {
    throw await withThumbnails(error, files);
  }
}

async function examineAll(sources: readonly Source[], judge: Judge, steps: Steps): Promise<ExaminedFile[]> {
  const recorder = new Recorder(asked(judge));
  const files: ExaminedFile[] = [];
  for (const source of inOrder(sources)) {
    files.push(await examine(source, recorder));
    await steps.step('Looking into files', files.length, sources.length);
  }
  return files;
}
