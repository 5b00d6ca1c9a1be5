/** Opens dropped or chosen files. */

import { CENTERLINE_EXTENSIONS, VOLUME_EXTENSIONS } from '../core/generated/tables';
import type { GivenFile, SeriesWish } from '../core/messages';
import { addSegmentation } from '../edit/branches';
import { isSegmentation } from '../edit/segmentation';
import { document_, hasEdits, saved, undo, undoWords } from '../state/history';
import { openingEnded, openWith } from '../state/opened';
import { askWhatIs } from '../state/questions';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { isSession, openSession } from './saving';
import { open } from './study';
import { leave } from './unsaved';

/** Opens files. A volume replaces the open study; centerlines are added to it. */
export function openFiles(files: readonly GivenFile[], first: SeriesWish = {}): Promise<void> {
  const before = store.notes.value;
  const wasEdited = document_.value.vessels.length > 0 || hasEdits.value;
  let isAgain = false;
  return openWith(first, (wish) => {
    const load = async () => {
      const opened = await engine.openFiles(files, wish, store.showProgress);
      const isVolume = opened.name !== undefined;
      // Centerlines that are opened again, with another choice, replace those opened before.
      if (isAgain && wasEdited && undoWords.value === 'open centerlines') {
        undo();
      }
      const isBeside = !isAgain || wasEdited || hasEdits.value;
      isAgain = true;
      return isVolume ? opened : { ...opened, ...beside(), isBeside, notes: [...before, ...opened.notes] };
    };
    return open(load, '');
  });
}

/** Markups and sessions may have any name that ends in `.json`. */
const CENTERLINES = [...CENTERLINE_EXTENSIONS, '.json'];
/** With the data files of headers. */
const VOLUMES = [...VOLUME_EXTENSIONS, '.raw', '.zraw'];

const areAll = (files: readonly GivenFile[], extensions: readonly string[]) =>
  files.every(({ path }) => extensions.some((extension) => path.toLowerCase().endsWith(extension)));

/** Opens files; first asks if their meaning is ambiguous or work would be lost. A session is opened after its scan. */
export async function takeFiles(files: readonly GivenFile[]): Promise<void> {
  const session = await sessionAmong(files);
  const areLines = areAll(files, CENTERLINES);
  const isMask = await isSegmentation(files);
  if (session || areLines || isMask) {
    // They belong to a scan, which may still be opening. A new scan replaces it instead.
    await openingEnded();
  }
  if (session) {
    const others = files.filter((file) => file !== session);
    await leave(async () => {
      if (others.length > 0) {
        await openFiles(others);
      }
      await goOn(session);
    });
  } else if (store.hasVolume.value && files.length > 0 && areAll(files, VOLUMES)) {
    askWhatIs({ files, canBeMask: await engine.fitsAsMask(files).catch(() => false) });
  } else if (store.hasVolume.value && files[0] && isMask) {
    await addSegmentation(files[0]);
  } else if (areLines) {
    await openFiles(files);
  } else {
    await replaceBy(files);
  }
}

/** Opens files instead of the open study. Files that cannot be opened are rejected before unsaved work is asked about. */
async function replaceBy(files: readonly GivenFile[]): Promise<void> {
  try {
    if (document_.value !== saved.value) {
      await engine.checkFiles(files);
    }
    await leave(() => openFiles(files));
  } catch (error) {
    store.showProblem(error);
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
    store.showProblem(error);
  }
}

/** What is known about the open volume, which stays when centerlines are added. */
function beside() {
  return { name: store.studyName.value, states: store.states.value };
}
