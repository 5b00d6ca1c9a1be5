/** Opening files that were dropped or chosen, and again what was refused with another wish. */
import { signal } from '@preact/signals';
import type { EngineClient } from '../core/engine';
import type { GivenFile, SeriesWish } from '../core/messages';
import * as store from './store';
import { open } from './study';

/** What was opened last, and how: after a refusal the same files are opened in another way. */
const last = signal<{ files: readonly GivenFile[]; wish: SeriesWish }>({ files: [], wish: {} });

/** Opens files: a volume in the place of all that is open, centerlines beside it. */
export function openFiles(
  engine: EngineClient,
  files: readonly GivenFile[],
  wish: SeriesWish = {},
): Promise<void> {
  last.value = { files, wish };
  const load = async () => {
    const opened = await engine.openFiles(files, wish, (told) => {
      store.progress.value = told;
    });
    const isVolume = opened.name !== undefined;
    return isVolume ? opened : { ...opened, ...beside(), notes: [...store.notes.value, ...opened.notes] };
  };
  return open(engine, load, '');
}

/** Opens the same files again, with one more wish. */
export function openAgain(engine: EngineClient, wish: SeriesWish): Promise<void> {
  return openFiles(engine, last.value.files, { ...last.value.wish, ...wish });
}

/** What is told of the volume that stays when centerlines come to it. */
function beside() {
  return { name: store.studyName.value, states: store.states.value };
}
