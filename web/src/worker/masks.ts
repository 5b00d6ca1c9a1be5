/** Reads a vessel mask of the open scan, and traces its vessels. */

import { Failure } from '../core/failure';
import type { AfterEdit, Answer, Attachments, GivenFile, Message, Question } from '../core/messages';
import { type Engine, loadJudge, loadPackedVolumes, loadVolumes } from '../core/module';
import { ALL_OF_IT } from '../io/dicom/wanted';
import { among, BlobSource } from '../io/source';
import { Steps } from '../io/steps';
import type { Study } from '../io/study';
import { ask, kindOf, refuseStopped } from './answers';

interface Asking {
  readonly attachments: Attachments;
  readonly signal: AbortSignal;
}

/** Answers a request after reading its mask, if it has one. Adds notes about the files to the answer. */
export async function askWithFiles<N extends Question>(
  engine: Engine,
  name: N,
  message: Message<N>,
  { attachments, signal }: Asking,
): Promise<Answer<N>> {
  const { mask, onProgress = () => undefined } = attachments;
  if (!mask) {
    return ask(engine, name, message, attachments);
  }
  try {
    const notes = await openAs(new MaskStudy(engine), mask, new Steps(onProgress, signal));
    refuseStopped(name, signal);
    const answer = ask(engine, name, message, attachments) as AfterEdit;
    const edited = { ...answer.edited, notes: [...notes, ...answer.edited.notes] };
    return { ...answer, edited } as AfterEdit as Answer<N>;
  } finally {
    engine.end_mask();
  }
}

/** Whether files can be a mask of the open scan, by their grid; their voxels are not read. */
export async function fitsAsMask(
  engine: Engine,
  files: readonly GivenFile[],
  steps: Steps,
): Promise<boolean> {
  const study = new GridStudy(engine);
  // Once the grid is known, the rest is not read.
  await openAs(study, files, steps).catch(() => undefined);
  return study.fits;
}

async function openAs(study: Study, files: readonly GivenFile[], steps: Steps): Promise<readonly string[]> {
  const sources = files.map(({ path, file }) => new BlobSource(path, file));
  const { openFiles } = await import('../io/study');
  const { notes } = await openFiles(sources, among(sources), ALL_OF_IT, {
    study,
    loadJudge,
    kindOf,
    loadVolumes,
    loadPackedVolumes,
    steps,
  });
  return notes;
}

class MaskStudy implements Study {
  constructor(protected readonly engine: Engine) {}

  begin_volume(header: string): void {
    this.engine.begin_mask(header);
  }

  take_voxels(offset: number, bytes: Uint8Array): void {
    this.engine.take_mask_voxels(offset, bytes);
  }

  openCenterlines(_bytes: Uint8Array, name: string): readonly string[] {
    throw new Failure('format', name, 'centerlines', 'a vessel mask', 'open the file as centerlines');
  }
}

class GridStudy extends MaskStudy {
  fits = false;

  override begin_volume(header: string): void {
    this.engine.check_mask(header);
    this.fits = true;
    throw new Failure('interrupted', 'mask', 'its grid', 'no voxels');
  }
}
