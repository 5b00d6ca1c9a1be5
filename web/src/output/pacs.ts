/** What is put beside the scan in a PACS: the server makes DICOM objects of it, which come back as a zip archive. Nothing is sent elsewhere. */
import { signal } from '@preact/signals';
import { engine } from '../client/shared';
import type { GivenFile } from '../core/messages';
import { inBase64, made, placeOf } from '../core/server';
import { type Finding, markedVessel } from '../measure/findings';
import { settingOf } from '../state/actions';
import { isMillimetreAssumed } from '../state/millimetres';
import { profileOfLine } from '../state/profiles';
import { reformationKind } from '../state/reformation';
import * as store from '../state/store';
import { tell } from '../state/telling';
import { fileName } from './file-names';
import { keyImage } from './key-image';
import { drawnPane } from './pane-picture';
import { composed, saveAs } from './pictures';
import { reported, reportOf } from './report';
import { pngOf, straightenedCanvas } from './report-pictures';

const SUBJECT = 'Save for PACS';
/** The version of what is sent. */
const VERSION = 1;
const UPRIGHT =
  'Straightened CPR. Rows: distance along the vessel, its first point on top. Columns: distance across it.';
const LYING =
  'Straightened CPR. Columns: distance along the vessel, its first point on the left. Rows: distance across it.';
/** The width of the straightened vessel where no pane shows it, and the side of its finest pixels (mm). */
const [WIDTH, FINEST] = [50, 0.25];
/** The most columns of it. */
const MOST_COLUMNS = 2000;

/** Into which study objects are put: that of the scan, one without a patient, or that of a file. */
export type PacsStudy = 'scan' | 'anonymous' | GivenFile;

/** A DICOM file that was chosen for its study, with what its reader is to see before objects are put there. */
export interface ChosenFile {
  readonly file: GivenFile;
  /** Name, ID, date, modality and body part, each with its label. */
  readonly facts: ReadonlyArray<readonly [string, string]>;
  /** What speaks against it, in sentences. */
  readonly doubts: readonly string[];
  /** Why it is refused; null where it is not. */
  readonly refusal: string | null;
}

/** Whether the page asks into which study objects are put. */
export const isPacsAsked = signal(false);

/** The chosen file that the page asks about. */
export const chosenFile = signal<ChosenFile | null>(null);

/** Asks about a chosen file before anything is put into its study. */
export async function askAboutFile(file: GivenFile): Promise<void> {
  const content = { study: await studyPart(file), fingerprint: fingerprint() };
  const response = await made('study', SUBJECT, content);
  chosenFile.value = { ...(await response.json()), file };
}

/** Asks into which study; refuses where no program serves the page that could make objects. */
export async function askForPacs(): Promise<void> {
  placeOf('objects', SUBJECT);
  isPacsAsked.value = true;
}

/** Saves the objects of what is shown. */
export async function savePacs(study: PacsStudy): Promise<void> {
  tell('Making the DICOM objects …');
  const response = await made('objects', SUBJECT, await requestOf(study));
  const scan = study === 'anonymous' ? null : store.studyName.value;
  saveAs(await response.blob(), fileName({ scan, content: 'pacs', ending: 'zip' }), 'Nothing was sent');
}

async function requestOf(study: PacsStudy): Promise<object> {
  const isAnonymous = study === 'anonymous';
  // Readers type names of vessels: without a patient they are left out, of pictures too.
  const findings = reported().map((one) => (isAnonymous ? { ...one, name: '' } : one));
  const parts: object[] = [];
  for (const finding of findings) {
    parts.push(await partOf(finding));
  }
  const vessels = findings.map(markedVessel);
  return {
    version: VERSION,
    study: await studyPart(study),
    fingerprint: fingerprint(),
    stated: store.states.value,
    view: await viewPart(),
    pane: await panePart(),
    findings: parts,
    numbers: await engine.ask('profiles_json', { vessels, is_millimetre_assumed: isMillimetreAssumed.value }),
    report: findings.length > 0 ? await (isAnonymous ? reportOf(findings, null) : reportOf(findings)) : '',
  };
}

/** What tells scans apart and names nobody. */
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

/** The turning view as it is shown. */
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

/** The reformation beside it; where none is shown, the picked vessel straightened, and nothing where none is picked. */
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
  const spacing = Math.max(FINEST, length / MOST_COLUMNS);
  return withWords(await straightenedCanvas(vessel, { width: WIDTH, spacing }), LYING + pixelWords(spacing));
}

const withWords = (shown: HTMLCanvasElement, axes: string): object => ({
  picture: pngOf(drawnPane(shown, axes)),
  axes,
});

/** How large a pixel is, where the scan tells it: no ruler of a viewer is true across such a picture. */
const pixelWords = (spacing: number): string =>
  store.states.value.spacing ? ` A pixel is ${spacing.toFixed(3)} mm.` : '';

/** A finding with its key image, and the contours of what is marked on it. */
async function partOf(finding: Finding): Promise<object> {
  const { line, marks } = finding;
  await profileOfLine(engine, line);
  const { places } = await engine.ask('report_plan', markedVessel(finding));
  const marked = places.filter((place) => !place.is_suggestion);
  const sections = marked.map(({ at }) => engine.ask('measured_section', { line, at }));
  const { stenosis } = await engine.ask('grade', { line, marks });
  return {
    picture: pngOf(await keyImage(finding)),
    points: (await engine.ask('line', { line })).points,
    contours: (await Promise.all(sections)).map(({ contour }, n) => [marked[n]?.at, contour]),
    marks: places.map((place) => [
      place.is_reference ? 'reference' : place.name,
      place.at,
      place.is_suggestion,
    ]),
    words: stenosis?.words ?? null,
  };
}
