/** Opens and closes a study; sets its windows and its first view. */

import { batch } from '@preact/signals';
import { Failure } from '../core/failure';
import type { Report } from '../core/messages';
import { middle } from '../core/vectors';
import { addLoaded } from '../edit/branches';
import { placeCrossHair } from '../state/cross-hair';
import { document_, hasEdits } from '../state/history';
import { forgetLines } from '../state/lines';
import { dropLength, forgetFindings } from '../state/measuring';
import { showMessage } from '../state/message';
import { forgetOpened, openWith, takeOpened } from '../state/opened';
import { beginMeasuring } from '../state/profiles';
import { putRulerAway } from '../state/rulers';
import { beginStudy, showAgain } from '../state/shown';
import * as store from '../state/store';
import { takeTool } from '../state/tool';
import { engine, type Opened } from '../worker/engine';

const FIRST_SIZE = [512, 512] as const;

/** What was opened. Centerlines may be added to existing vessels. */
export interface Loaded extends Opened {
  readonly isBeside?: boolean;
}

export async function open(load: () => Promise<Loaded>, name: string): Promise<void> {
  batch(() => {
    store.closeProblem();
    store.showProgress({ words: 'Opening', done: 0, total: null });
  });
  try {
    const opened = await load();
    const isEdited = document_.value.vessels.length > 0 || hasEdits.value;
    const comesToEdits = opened.isBeside && store.hasVolume.value && isEdited;
    await (comesToEdits ? showBeside(opened) : showStudy(opened, opened.name ?? name));
    const doubt = misread(opened);
    if (doubt) {
      store.setProblem(doubt);
    }
  } catch (error) {
    const failure = Failure.of(error);
    if (failure.kind !== 'interrupted') {
      store.setProblem(failure);
    }
    await forgetWhatIsClosed();
  } finally {
    store.showProgress(null);
  }
}

/** The doubt about the coordinate system of centerlines, with remedies; null if there is none. */
function misread({ doubt }: Loaded): Failure | null {
  const values = doubt?.readings ?? [];
  const mends = [{ name: 'reading', values }] as const;
  const expected = 'lines with the size and position of vessels';
  return doubt && values.length > 0
    ? new Failure('format', 'Centerlines', doubt.found, expected, '', { mends })
    : null;
}

/** After a failure, closes the study in the page if the engine has already closed it. */
async function forgetWhatIsClosed(): Promise<void> {
  const { volume, vessels } = await engine.ask('report', null);
  if (!volume && !vessels) {
    layDown();
    batch(forget);
  }
}

export function openPhantom(name: string): Promise<void> {
  return openWith({}, (wish) => {
    const load = async () => ({ report: await engine.openPhantom(name, wish), notes: [] });
    return open(load, `phantom ${name}`);
  });
}

export function openAddresses(volume: string | null, centerlines: string | null): Promise<void> {
  return openWith({}, (wish) => {
    const load = () => engine.openAddresses({ volume, centerlines }, wish, store.showProgress);
    return open(load, '');
  });
}

/** Closes the study. The views are removed first, so that none requests data that is gone. */
export async function close(): Promise<void> {
  layDown();
  batch(forget);
  await engine.ask('close', null);
}

/** Ends tracing and measuring, and restores the layout before them. */
function layDown(): void {
  takeTool('look');
  if (store.layout.value === 'measure') {
    store.setLayout('strip');
  }
}

async function showStudy({ report, notes, states, study = null }: Opened, name: string): Promise<void> {
  const size = store.camera.value?.size ?? FIRST_SIZE;
  const camera = await engine.ask('fitted', { view: 'anterior', size: size });
  const histogram = report.volume ? await engine.ask('histogram', { bins: 128 }) : null;
  const hair = await firstPlace(report);
  const vessels = await engine.ask('begin_document', null);
  layDown();
  batch(() => {
    forget();
    takeOpened({
      report,
      name,
      notes,
      states: states ?? { spacing: true, orientation: true },
      study,
      histogram,
      camera,
      hair,
    });
    beginStudy(vessels);
  });
  const doubt = report.volume?.doubt;
  if (doubt) {
    showMessage(`${doubt[0]?.toUpperCase()}${doubt.slice(1)}.`);
  }
}

async function showBeside({ report, notes }: Opened): Promise<void> {
  const loaded = report.vessels ?? [];
  await addLoaded(loaded);
  await showAgain();
  store.setNotes(notes);
  const line = loaded[longest(report)]?.line;
  const shown = store.report.value?.vessels ?? [];
  const vessel = shown.findIndex((one) => one.line === line);
  if (vessel >= 0) {
    const arcLength = (shown[vessel]?.length ?? 0) / 2;
    const [point] = await engine.ask('across', { vessel, at: arcLength });
    const { value } = await engine.ask('at', point);
    placeCrossHair({ point, value, vessel, arc_length: arcLength }, 'turning');
  }
}

/** First position of the cross-hair: half way along the longest vessel, or the centre of the volume. */
async function firstPlace(report: Report): Promise<store.CrossHair | null> {
  if (report.vessels?.length) {
    const vessel = longest(report);
    const arcLength = (report.vessels[vessel]?.length ?? 0) / 2;
    const [point] = await engine.ask('across', { vessel, at: arcLength });
    const { value } = await engine.ask('at', point);
    return { point, value, vessel, arcLength };
  }
  if (!report.volume) {
    return null;
  }
  const { point, value } = await engine.ask('at', middle(report.volume.corners));
  return { point, value, vessel: null, arcLength: null };
}

function longest(report: Report): number {
  const lengths = (report.vessels ?? []).map((vessel) => vessel.length);
  return lengths.indexOf(Math.max(...lengths));
}

function forget(): void {
  beginMeasuring();
  forgetFindings();
  putRulerAway();
  dropLength();
  forgetOpened();
  forgetLines();
  beginStudy(null);
}
