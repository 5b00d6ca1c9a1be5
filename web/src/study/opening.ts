/** Opening files that were dropped or chosen. */
import { signal } from '@preact/signals';
import type { EngineClient } from '../client/engine';
import { Failure } from '../core/failure';
import type { GivenFile, SeriesWish } from '../core/messages';
import { addSegmentation } from '../edit/branches';
import { isSegmentation } from '../edit/segmentation';
import { isSession, openSession } from '../session/saving';
import { document_, hasEdits, undo, undoWords } from '../state/history';
import { openWith } from '../state/last-opened';
import * as store from '../state/store';
import { leave } from './leaving';
import { open } from './study';

/** Opens files: a volume in the place of all that is open, centerlines beside it. */
export function openFiles(
  engine: EngineClient,
  files: readonly GivenFile[],
  first: SeriesWish = {},
): Promise<void> {
  const before = store.notes.value;
  const wasEdited = document_.value.vessels.length > 0 || hasEdits.value;
  let isAgain = false;
  return openWith(first, (wish) => {
    const load = async () => {
      const opened = await engine.openFiles(files, wish, (told) => {
        store.progress.value = told;
      });
      const isVolume = opened.name !== undefined;
      // Lines that are read again take the place of those before.
      if (isAgain && wasEdited && undoWords.value === 'open centerlines') {
        undo();
      }
      const isBeside = !isAgain || wasEdited || hasEdits.value;
      isAgain = true;
      return isVolume ? opened : { ...opened, ...beside(), isBeside, notes: [...before, ...opened.notes] };
    };
    return open(engine, load, '');
  });
}

/** A volume that came while another one is open: it can be another scan, or a mask of vessels of the one that is open. */
export const question = signal<readonly GivenFile[] | null>(null);

/** Centerlines come to what is open. */
const CENTERLINES = /\.(vtp|vtk|fcsv|pth|swc|tre|csv|json)$/i;
const VOLUMES = /\.(nii|nii\.gz|nrrd|nhdr|mha|mhd|hdr|img|raw|zraw)$/i;

/** Opens files that were dropped or chosen, after asking what they are where that is open; a session after its scan. */
export async function takeFiles(engine: EngineClient, files: readonly GivenFile[]): Promise<void> {
  const session = await sessionAmong(files);
  if (session) {
    const others = files.filter((file) => file !== session);
    await leave(async () => {
      if (others.length > 0) {
        await openFiles(engine, others);
      }
      await goOn(session);
    });
  } else if (store.hasVolume.value && files.length > 0 && files.every(({ path }) => VOLUMES.test(path))) {
    question.value = files;
  } else if (store.hasVolume.value && files[0] && (await isSegmentation(files))) {
    await addSegmentation(engine, files[0]);
  } else if (files.every(({ path }) => CENTERLINES.test(path))) {
    await openFiles(engine, files);
  } else {
    await leave(() => openFiles(engine, files));
  }
}

async function sessionAmong(files: readonly GivenFile[]): Promise<GivenFile | null> {
  for (const file of files) {
    if (await isSession(file)) {
      return file;
    }
  }
  return null;
}

async function goOn(session: GivenFile): Promise<void> {
  try {
    await openSession(session);
  } catch (error) {
    store.problem.value = Failure.of(error);
  }
}

/** What is told of the volume that stays when centerlines come to it. */
function beside() {
  return { name: store.studyName.value, states: store.states.value };
}
