/** Opens dropped, chosen or fetched files as a volume, as its centerlines, or both. */
import { FILES } from '../core/generated/tables';
import type { ScanStudy, States } from '../core/messages';
import type { Judge } from '../core/module';
import type { Volumes } from '../core/volumes';
import type { Wanted } from './dicom/wanted';
import { type KindOf, type Known, known } from './kinds';
import { type Beside, fileName, type Source } from './source';
import type { Steps } from './steps';
import { readVolume, type Sink } from './volume-file';
import { formatFailure } from './words';

/** Receives the volume and centerlines of a study; implemented by the engine and by test doubles. */
export interface Study extends Sink {
  openCenterlines(bytes: Uint8Array, name: string): readonly string[];
  sideNotes?(text: string): readonly string[];
}

export interface LoadContext {
  readonly study: Study;
  readonly loadJudge: () => Promise<Judge>;
  readonly kindOf: KindOf;
  readonly loadVolumes: () => Promise<Volumes>;
  readonly loadPackedVolumes: () => Promise<Volumes>;
  readonly steps: Steps;
}

export interface Opened {
  readonly volume: Volume | null;
  readonly notes: readonly string[];
}

interface Volume {
  /** The DICOM study of the volume; null for other formats. */
  readonly study: ScanStudy | null;
  readonly name: string;
  readonly notes: readonly string[];
  readonly states: States;
}

/** DICOM files always state voxel spacing and orientation. */
const STATED: States = { spacing: true, orientation: true };

interface Sorted {
  readonly volumes: readonly Known[];
  readonly dicom: readonly Source[];
  readonly archives: readonly Source[];
  readonly lines: readonly Known[];
  readonly others: readonly Known[];
}

/** Opens files. A volume replaces the open study; centerlines are added to it. */
export async function openFiles(
  sources: readonly Source[],
  beside: Beside,
  wanted: Wanted,
  context: LoadContext,
): Promise<Opened> {
  const sorted = await sort(sources, context);
  requireOne(sorted);
  const volume = await openVolume(sorted, sources, { beside, wanted, ...context });
  const [lines] = sorted.lines;
  const notes = lines ? await openLines(lines.source, context) : [];
  return { volume, notes: [...(volume?.notes ?? []), ...notes] };
}

/** Rejects files that are no scan or centerlines, by their first bytes. */
export async function checkFiles(
  sources: readonly Source[],
  means: Pick<LoadContext, 'kindOf' | 'steps'>,
): Promise<void> {
  requireOne(await sort(sources, means));
}

/** Adds centerlines. Returns notes. */
export async function openLines(
  source: Source,
  { study, kindOf, steps }: LoadContext,
): Promise<readonly string[]> {
  const found = await known(source, kindOf);
  if (found.role === 'volume' || found.mend) {
    const mend = found.mend || 'trace a mask with `lumencut trace` and open the result';
    throw formatFailure(source.path, found.words, FILES.centerlines, mend);
  }
  await steps.step('Centerlines', 0, null);
  return study.openCenterlines(await source.slice(0, source.size), fileName(source.path));
}

async function sort(
  sources: readonly Source[],
  { kindOf, steps }: Pick<LoadContext, 'kindOf' | 'steps'>,
): Promise<Sorted> {
  const every: Known[] = [];
  for (const source of sources) {
    every.push(await known(source, kindOf));
    await steps.step('Looking into files', every.length, sources.length);
  }
  const read = every.filter((one) => one.mend === '');
  const of = (kind: string) => read.filter((one) => one.kind === kind).map((one) => one.source);
  return {
    volumes: read.filter((one) => isVolumeFile(one) && !isVoxelsOf(one, every)),
    dicom: of('dicom'),
    archives: of('zip'),
    lines: read.filter((one) => one.role === 'centerlines'),
    others: every.filter((one) => one.mend !== '' || one.role === 'other'),
  };
}

/** Whether a file is a complete volume, unlike DICOM files and archives. */
const isVolumeFile = ({ role, kind }: Known): boolean =>
  role === 'volume' && kind !== 'dicom' && kind !== 'zip';

/** Whether a file holds the voxels of a header among the files. */
function isVoxelsOf({ source }: Known, every: readonly Known[]): boolean {
  const stem = /^(.*)\.img(\.gz)?$/i.exec(source.path)?.[1];
  return (
    stem !== undefined &&
    every.some((one) => one.source.path.toLowerCase().startsWith(`${stem.toLowerCase()}.hdr`))
  );
}

function requireOne({ volumes, dicom, archives, lines, others }: Sorted): void {
  const every = [...volumes.map((one) => one.source), ...archives, ...dicom.slice(0, 1)];
  const [first, second] = every;
  if (first && second) {
    const found = `${every.length} volumes, ${every.length > 2 ? 'including ' : ''}${fileName(first.path)} and ${fileName(second.path)}`;
    const mend = 'choose only the scan; trace a vessel mask with `lumencut trace`';
    throw formatFailure('files', found, 'one volume and its centerlines', mend);
  }
  if (lines.length > 1) {
    const found = `${lines.length} files of centerlines`;
    throw formatFailure('files', found, 'one volume and its centerlines', 'choose one of them');
  }
  if (every.length + lines.length === 0) {
    throw unknown(others);
  }
}

function unknown(others: readonly Known[]): Error {
  const [first] = others;
  if (!first) {
    return formatFailure('files', 'none', FILES.volumes, 'choose at least one file');
  }
  const hasMore = others.length > 1 ? ` (and ${others.length - 1} more)` : '';
  const expected = `${FILES.volumes}, or ${FILES.centerlines}`;
  return formatFailure(first.source.path, `${first.words}${hasMore}`, expected, first.mend);
}

interface Asked extends LoadContext {
  readonly beside: Beside;
  readonly wanted: Wanted;
}

async function openVolume(sorted: Sorted, every: readonly Source[], asked: Asked): Promise<Volume | null> {
  const [volume] = sorted.volumes;
  if (volume) {
    return openFile(volume.source, asked);
  }
  const [archive] = sorted.archives;
  if (!archive && sorted.dicom.length === 0) {
    return null;
  }
  const [{ openDicom }, judge] = await Promise.all([import('./dicom'), asked.loadJudge()]);
  const lines = sorted.lines.map((one) => one.source);
  const sources = archive ? await membersOf(archive) : every.filter((source) => !lines.includes(source));
  const subject = archive?.path ?? commonName(sources);
  const series = { subject, sources, wanted: asked.wanted };
  const read = await openDicom(series, judge, asked.study, asked.steps);
  const header = read.study ? new TextDecoder('latin1').decode(read.study.header) : '';
  const notes = [...read.notes, ...sideNotes(asked.study, header)];
  return { ...read, notes, name: fileName(subject), states: STATED };
}

async function membersOf(archive: Source): Promise<Source[]> {
  const zip = await import('./dicom/archive');
  return zip.membersOf(archive);
}

async function openFile(source: Source, { study, ...asked }: Asked): Promise<Volume> {
  const {
    notes: stated,
    description,
    spacing,
    orientation,
  } = await readVolume(source, { ...asked, sink: study });
  const notes = [...stated, ...sideNotes(study, description)];
  return { study: null, name: fileName(source.path), notes, states: { spacing, orientation } };
}

const sideNotes = (study: Study, text = ''): readonly string[] => (text && study.sideNotes?.(text)) || [];

/** The folder that all files have in common; for a single file, its path. */
function commonName(sources: readonly Source[]): string {
  const [first] = sources;
  if (!first || sources.length === 1) {
    return first?.path ?? 'files';
  }
  const folders = first.path.split('/').slice(0, -1);
  const isShared = (count: number) => {
    const start = `${folders.slice(0, count).join('/')}/`;
    return sources.every((source) => source.path.startsWith(start));
  };
  const count = folders.findLastIndex((_, i) => isShared(i + 1)) + 1;
  return count > 0 ? folders.slice(0, count).join('/') : 'files';
}
