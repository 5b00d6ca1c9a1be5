/** Opens DICOM: one greyscale series from a folder, a zip archive or single files becomes one volume, with its study. */

import type { ReadScan } from '../../core/messages';
import type { Judge } from '../../core/module';
import { type Bytes, inOrder, type Source } from '../source';
import type { Steps } from '../steps';
import type { Sink } from '../volume-file';
import { formatFailure } from '../words';
import { unlikePairs } from './comparing';
import { type ExaminedFile, examine, pixelsOf } from './headers';
import { asked, judged, type Plan } from './judging';
import { isDicom } from './parsing';
import { Recorder } from './records';
import { loadStack } from './stack';
import { withThumbnails } from './thumbnails';
import type { Wanted } from './wanted';

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

/** The bytes before the pixel data; the whole file if it has no pixels or is deflated. */
export async function headOf(source: Source): Promise<Bytes> {
  if (!isDicom(await source.slice(0, Math.min(source.size, 256)))) {
    const advice = 'choose a file from the DICOM folder of the scan';
    throw formatFailure(source.path, 'no DICOM', 'a DICOM file of the study', advice);
  }
  const { pixels, isDeflated } = await pixelsOf(source);
  return source.slice(0, pixels && !isDeflated ? pixels.at : source.size);
}

/** The study of a series: the header of one of its images, and the UIDs of all its images. */
export async function studyOf(plan: Plan, files: readonly ExaminedFile[]): Promise<ReadScan | null> {
  const images = [...new Set(plan.slices.map(({ file }) => files[file]?.image))].filter((one) => !!one);
  const [first] = images;
  if (!first) {
    return null;
  }
  const instances = images.map(({ header }) => header.attributes.SOPInstanceUID);
  return {
    isServed: false,
    hasStudy: true,
    header: await headOf(first.source),
    instances: [...new Set(instances.filter((uid) => typeof uid === 'string'))],
    studyCount: new Set(images.map(({ study }) => study)).size,
    identity: {
      patient: plan.patient.id,
      issuer: plan.patient.issuer,
      modality: plan.details.modality,
    },
  };
}
