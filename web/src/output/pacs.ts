/** Saves DICOM objects for a PACS. The server of the page makes a zip archive of them; nothing is sent elsewhere. */

import { DEFAULTS } from '../core/generated/tables';
import type { GivenFile } from '../core/messages';
import { inBase64, made, placeOf } from '../core/server';
import type { Finding } from '../measure/findings';
import { settingOf } from '../state/actions';
import { showMessage } from '../state/message';
import { profileOfLine } from '../state/profiles';
import { chooseFile, setPacsAsked } from '../state/questions';
import { reformationKind } from '../state/reformation';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { fileName } from './file-names';
import { keyImage } from './key-image';
import { drawnPane } from './pane-picture';
import { composed, saveAs } from './pictures';
import { reported, reportOf } from './report';
import { pngOf, straightenedCanvas } from './report-pictures';

const SUBJECT = 'Save for PACS';
const VERSION = 2;
const UPRIGHT =
  'Straightened CPR. Rows: distance along the vessel, its first point on top. Columns: distance across it.';
const LYING =
  'Straightened CPR. Columns: distance along the vessel, its first point on the left. Rows: distance across it.';
const MOST_COLUMNS = 2000;

export type PacsStudy = 'scan' | 'anonymous' | GivenFile;

export async function askAboutFile(file: GivenFile): Promise<void> {
  const content = { study: await studyPart(file), fingerprint: fingerprint() };
  const response = await made('study', SUBJECT, content);
  chooseFile({ ...(await response.json()), file });
}

/** Asks for the study of the objects. Throws if the server cannot create DICOM objects. */
export async function askForPacs(): Promise<void> {
  placeOf('objects', SUBJECT);
  setPacsAsked(true);
}

export async function savePacs(study: PacsStudy): Promise<void> {
  showMessage('Creating the DICOM objects …');
  const response = await made('objects', SUBJECT, await requestOf(study));
  const scan = study === 'anonymous' ? null : store.studyName.value;
  saveAs(await response.blob(), fileName({ scan, content: 'pacs', ending: 'zip' }), 'Nothing was sent');
}

async function requestOf(study: PacsStudy): Promise<object> {
  const isAnonymous = study === 'anonymous';
  // Vessel names are typed by users and may identify a patient, so anonymous objects omit them.
  const findings = reported().map((one) => (isAnonymous ? { ...one, name: '' } : one));
  const parts: object[] = [];
  for (const finding of findings) {
    parts.push(await partOf(finding));
  }
  return {
    version: VERSION,
    study: await studyPart(study),
    fingerprint: fingerprint(),
    stated: store.states.value,
    view: await viewPart(),
    pane: await panePart(),
    findings: parts,
    report: findings.length > 0 ? await (isAnonymous ? reportOf(findings, null) : reportOf(findings)) : '',
  };
}

/** Text that identifies a scan without any data of the patient. */
function fingerprint(): string {
  const volume = store.report.value?.volume;
  return JSON.stringify([volume?.size, volume?.world_from_index, store.histogram.value]);
}

async function studyPart(study: PacsStudy): Promise<object> {
  const known = store.scanStudy.value;
  const read = known?.isServed === false ? known : null;
  const own = read && (await inBase64(new Blob([read.header])));
  const isOwn = typeof study === 'string';
  const isPlaced = store.states.value.spacing && store.states.value.orientation;
  return {
    choice: isOwn ? study : 'like',
    is_served: known?.isServed ?? false,
    header: isOwn ? own : await inBase64(new Blob([await engine.dicomHead(study)])),
    scan: own,
    corners: (isPlaced && store.report.value?.volume?.corners) || null,
    instances: read?.instances ?? [],
    study_count: read?.studyCount ?? 1,
  };
}

async function viewPart(): Promise<object> {
  const canvas = await composed('labels');
  const camera = store.camera.value;
  const focus = settingOf('focus');
  return {
    picture: pngOf(canvas),
    camera: camera && { ...camera, pixel_spacing: (camera.pixel_spacing * camera.size[1]) / canvas.height },
    method: store.method.value,
    settings: store.viewSettings.value,
    has_cut: store.hasTree.value && !(Array.isArray(focus) && Number(focus[0]) < 0),
  };
}

/** The displayed reformation, or else the straightened picked vessel; null if no vessel is picked. */
async function panePart(): Promise<object | null> {
  const vessel = store.pickedVessel.value;
  const length = store.report.value?.vessels?.[vessel ?? -1]?.length ?? 0;
  const isUpright = reformationKind.value === 'cpr';
  const axes = isUpright ? UPRIGHT : document.querySelector<HTMLElement>('.reformed .axes')?.title;
  const shown = document.querySelector<HTMLCanvasElement>('[data-testid=straightened] canvas.flat');
  if (axes && shown && shown.width > 1) {
    return withWords(shown, isUpright ? axes + pixelWords(length / (shown.height - 1)) : axes);
  }
  if (vessel === null || length === 0) {
    return null;
  }
  const side = store.report.value?.volume?.pixel_side ?? 0;
  const spacing = Math.max(side, length / MOST_COLUMNS);
  const picture = await straightenedCanvas(vessel, { width: DEFAULTS['cpr.width'], spacing });
  return withWords(picture, LYING + pixelWords(spacing));
}

const withWords = (shown: HTMLCanvasElement, axes: string): object => ({
  picture: pngOf(drawnPane(shown, axes)),
  axes,
});

/** A sentence that states the pixel size, since rulers of DICOM viewers are not valid in such a picture. */
const pixelWords = (spacing: number): string =>
  store.states.value.spacing ? ` A pixel is ${spacing.toFixed(3)} mm.` : '';

async function partOf(finding: Finding): Promise<object> {
  const { line, name, marks } = finding;
  await profileOfLine(line);
  return {
    picture: pngOf(await keyImage(finding)),
    name,
    points: (await engine.ask('line', { line })).points,
    profile: await engine.ask('profile_record', { line }),
    marks,
  };
}
