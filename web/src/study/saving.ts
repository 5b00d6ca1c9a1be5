/** Saves and opens sessions. */

import { batch, effect, untracked } from '@preact/signals';
import { CRASH, Failure } from '../core/failure';
import { SESSION_FIELD } from '../core/generated/tables';
import type {
  Asked,
  Bytes,
  DocumentVessel,
  GivenFile,
  LineContent,
  LineId,
  Method,
  SavedView,
} from '../core/messages';
import { STANDARD } from '../core/planes';
import { settled } from '../core/slices';
import { shownVessels } from '../state/changes';
import { recover } from '../state/device';
import type { Document } from '../state/document';
import { document_ } from '../state/history';
import { contents } from '../state/lines';
import { showMessage } from '../state/message';
import { showView } from '../state/opened';
import { giveFwhm, givenFwhm } from '../state/profiles';
import { beginDocument, pickedId, tree } from '../state/shown';
import * as store from '../state/store';
import { keepComparison, savedComparison } from '../state/two-scans';
import { EngineClient, engine } from '../worker/engine';
import { cameraOf, contentOf, type DisplayState, documentOf } from './session-content';

/** Bytes to read from the start of a file to find the session field, which precedes the curves. */
const HEAD = 4096;

export async function isSession({ file }: GivenFile): Promise<boolean> {
  return /\.json$/i.test(file.name) && (await file.slice(0, HEAD).text()).includes(`"${SESSION_FIELD}"`);
}

/** The session as a file. After a crash, a new engine writes it from the data that the page holds. */
export async function savedSession(): Promise<Bytes> {
  const report = store.report.value;
  if (!report?.volume) {
    throw new Failure('session', 'session', 'no scan', 'an open scan');
  }
  const written = async (asked: Asked, document: Document) => {
    const content = contentOf(document, report, displayState(), givenFwhm.value);
    return (await asked.ask('write_session', content)).bytes;
  };
  try {
    return await written(engine, document_.value);
  } catch (error) {
    if (Failure.of(error).kind !== CRASH) {
      throw error;
    }
    return byAnother(async (other) =>
      written(other, await handedOver(other, document_.value, contents.value)),
    );
  }
}

/** Runs work in a temporary engine without a scan. */
async function byAnother<T>(work: (other: Asked) => Promise<T>): Promise<T> {
  const other = new EngineClient();
  try {
    await other.start('cpu');
    return await work(other);
  } finally {
    other.end();
  }
}

function displayState(): DisplayState | null {
  const camera = store.camera.value;
  const id = pickedId();
  return (
    camera && {
      camera,
      method: store.method.value,
      settings: store.viewSettings.value,
      layout: store.layout.value,
      crossHair: store.crossHair.value?.point ?? null,
      slices: store.slices.value,
      compared: savedComparison(),
      picked: id === null ? null : { id, at: store.pickedPlace.value },
    }
  );
}

/** Opens a session of the open scan. The engine rejects sessions of other scans. */
export async function openSession({ file }: GivenFile): Promise<void> {
  const content = await engine.ask(
    'read_session',
    { name: file.name },
    { bytes: new Uint8Array(await file.arrayBuffer()) },
  );
  const { view, compared } = content.session;
  const document = documentOf(content);
  batch(() => {
    beginDocument(document);
    giveFwhm(content.session.fwhm_mm);
    if (view) {
      look(view);
    }
  });
  if (!keepComparison(compared)) {
    showMessage(
      'This session compares the scan with another one: open that one by the layout "Two scans …".',
    );
  }
  if (view) {
    onceShown(document, () => point(view, document));
  }
}

/** Runs `work` once the vessels of the document are displayed, unless the document changes before. */
function onceShown(document: Document, work: () => void): void {
  const wanted = shownVessels(document);
  const end = effect(() => {
    const isChanged = document_.value !== document;
    const isShown =
      tree.value.length === wanted.length && wanted.every((vessel, n) => vessel === tree.value[n]);
    if (isChanged || isShown) {
      queueMicrotask(() => end());
    }
    if (isShown && !isChanged) {
      untracked(work);
    }
  });
}

function point({ picked, cross_hair: place }: SavedView, document: Document): void {
  const number = picked ? tree.value.indexOf(document.vessels[picked.vessel] as DocumentVessel) : -1;
  if (picked && number >= 0) {
    store.pickVessel(number, picked.at_mm);
  }
  if (place) {
    void engine.ask('at', place).then(({ value, vessel, arc_length: arcLength }) => {
      if (store.crossHair.value?.point === place) {
        store.setCrossHair({ point: place, value, vessel, arcLength });
      }
    }, recover);
  }
}

function look(view: SavedView): void {
  const { window, context_window: _, ...settings } = view.settings;
  const size = store.camera.value?.size ?? view.camera.size;
  showView({
    camera: cameraOf(view, size),
    method: view.method as Method,
    settings,
    window: Array.isArray(window) ? [Number(window[0]), Number(window[1])] : null,
    layout: view.layout,
    crossHair: view.cross_hair,
    slices: view.slices ? settled(view.slices) : STANDARD,
  });
}

/** The document with line numbers of the other engine. Vessels whose lines were not loaded are dropped. */
export async function handedOver(
  other: Asked,
  document: Document,
  contents: ReadonlyMap<LineId, LineContent>,
): Promise<Document> {
  const vessels = document.vessels.map(async (vessel) => {
    const content = contents.get(vessel.line);
    return content ? [{ ...vessel, line: await other.ask('add_line', content) }] : [];
  });
  return { ...document, vessels: (await Promise.all(vessels)).flat() };
}
