/** Loads a study from the server of the page: a voxel stream of `lumencut view` or a file, and centerlines. */
import { Failure } from '../core/failure';
import type { Progress, ScanIdentity, ScanStudy, States } from '../core/messages';
import { ALL_OF_IT } from '../io/dicom/wanted';
import { type Beside, BlobSource, fileName } from '../io/source';
import type { Study } from '../io/study';
import { ByteReader } from './byte-reader';
import type { LoadContext } from './replacing';

export type OnProgress = (progress: Progress) => void;

const MAGIC = 'LCVOLUME';
const LONGEST_HEADER = 16 << 20;

interface Addresses {
  readonly volume: string | null;
  readonly centerlines: string | null;
}

interface Header {
  readonly size: readonly [number, number, number];
  readonly dtype: string;
  readonly world_from_index: readonly (readonly number[])[];
  readonly notes?: readonly string[];
  readonly name?: string;
  readonly states_spacing?: boolean;
  readonly states_orientation?: boolean;
  readonly has_study?: boolean;
  readonly identity?: ScanIdentity;
}

export interface Fetched {
  readonly notes: readonly string[];
  readonly name: string;
  readonly states: States;
  readonly study: ScanStudy | null;
}

/** Loads the volume, then the centerlines. Returns notes, and the name of the volume. */
export async function fetchStudy(
  context: LoadContext,
  addresses: Addresses,
  onProgress: OnProgress,
): Promise<Fetched> {
  let fetched: Fetched = { notes: [], name: '', states: { spacing: true, orientation: true }, study: null };
  if (addresses.volume !== null) {
    fetched = await fetchVolume(context, addresses.volume, onProgress);
  } else {
    context.study.close();
  }
  if (addresses.centerlines === null) {
    return fetched;
  }
  onProgress({ words: 'Centerlines', done: 0, total: null });
  const lines = await fetchFile(await answered(addresses.centerlines, context.steps.signal));
  const { openLines } = await import('../io/study');
  return { ...fetched, notes: [...fetched.notes, ...(await openLines(lines, context))] };
}

async function answered(address: string, signal: AbortSignal): Promise<Response> {
  const response = await fetch(address, { signal, cache: 'no-store' });
  if (response.ok) {
    return response;
  }
  const text = await response.text();
  const failure = Failure.of(text);
  throw failure.kind === 'unexpected'
    ? new Failure(
        'file',
        address,
        `HTTP status ${response.status}`,
        'a file',
        'check the program that serves the page',
      )
    : failure;
}

async function fetchVolume(context: LoadContext, address: string, onProgress: OnProgress): Promise<Fetched> {
  const { signal } = context.steps;
  const response = await answered(address, signal);
  if (!response.body) {
    throw new Failure('file', address, 'an answer without content', 'a volume');
  }
  const bytes = new ByteReader(response.body);
  const start = await bytes.take(MAGIC.length + 4);
  if (new TextDecoder().decode(start.subarray(0, MAGIC.length)) !== MAGIC) {
    return fetchFormat(context, response, { start, bytes, onProgress });
  }
  const header = await readHeader(bytes, start, address);
  const total = await readVoxels(context.study, bytes, header, onProgress);
  if (bytes.count < total) {
    await refuseShort(address, signal, bytes.count, total);
  }
  const states = {
    spacing: header.states_spacing !== false,
    orientation: header.states_orientation !== false,
  };
  const study: ScanStudy = {
    isServed: true,
    hasStudy: header.has_study === true,
    identity: header.identity ?? null,
  };
  return { notes: header.notes ?? [], name: header.name ?? '', states, study };
}

interface Begun {
  readonly start: Uint8Array;
  readonly bytes: ByteReader;
  readonly onProgress: OnProgress;
}

/** Reads a response like a file that a user drops. */
async function fetchFormat(
  context: LoadContext,
  response: Response,
  { start, bytes, onProgress }: Begun,
): Promise<Fetched> {
  const total = Number(response.headers.get('Content-Length')) || null;
  const parts: BlobPart[] = [start.slice()];
  for (let part = await bytes.takeWhole(1); part.length > 0; part = await bytes.takeWhole(1)) {
    parts.push(part.slice());
    onProgress({
      words: 'Fetching',
      done: bytes.count,
      total: total === null || bytes.count > total ? null : total,
    });
  }
  const name = fileName(new URL(response.url).pathname);
  const sources = [new BlobSource(decodeURIComponent(name), new Blob(parts))];
  const { openFiles } = await import('../io/study');
  const { volume, notes } = await openFiles(
    sources,
    besideOf(response.url, context.steps.signal),
    ALL_OF_IT,
    context,
  );
  if (!volume) {
    throw new Failure('format', name, 'centerlines', 'a volume', 'load the file as centerlines');
  }
  return { ...volume, notes };
}

/** Finds files in the folder of an address, on the same origin. */
function besideOf(address: string, signal: AbortSignal): Beside {
  return async (path) => {
    const response = await fetch(new URL(encodeURI(path), address), { signal, cache: 'no-store' });
    return response.ok ? fetchFile(response) : null;
  };
}

async function fetchFile(response: Response): Promise<BlobSource> {
  const name = decodeURIComponent(fileName(new URL(response.url).pathname));
  return new BlobSource(name || 'centerlines', await response.blob());
}

async function readHeader(bytes: ByteReader, start: Uint8Array, address: string): Promise<Header> {
  const length = start.length === 12 ? new DataView(start.buffer, start.byteOffset).getUint32(8, true) : 0;
  if (length === 0 || length > LONGEST_HEADER) {
    throw new Failure('format', address, 'a stream without a header', 'a stream of voxels', 'open it again');
  }
  return checkedHeader(new TextDecoder().decode(await bytes.take(length)));
}

function checkedHeader(text: string): Header {
  const read = parsed(text);
  const isWhole =
    Array.isArray(read?.size) &&
    read.size.length === 3 &&
    typeof read.dtype === 'string' &&
    read.world_from_index;
  if (!read || !isWhole) {
    const found = read ? `only ${Object.keys(read).join(', ') || 'an empty one'}` : 'a text that is not JSON';
    const expected = 'size, dtype and world_from_index as JSON';
    throw new Failure('format', 'header of the volume', found, expected, 'open it again');
  }
  return read;
}

function parsed(text: string): Header | null {
  try {
    return JSON.parse(text) as Header | null;
  } catch {
    return null;
  }
}

/** Streams the voxels to the engine; returns the expected number of bytes. */
async function readVoxels(
  study: Study,
  bytes: ByteReader,
  header: Header,
  onProgress: OnProgress,
): Promise<number> {
  const { dtype, narrow, bytesPerVoxel } = narrowed(header.dtype);
  const voxels = header.size[0] * header.size[1] * header.size[2];
  const total = bytes.count + voxels * bytesPerVoxel;
  study.begin_volume(JSON.stringify({ ...header, dtype }));
  let offset = 0;
  for (;;) {
    const part = await bytes.takeWhole(bytesPerVoxel);
    if (part.length === 0) {
      return total;
    }
    const stored = narrow(part);
    study.take_voxels(offset, stored);
    offset += stored.length;
    onProgress({ words: 'Volume', done: bytes.count, total });
  }
}

/** Throws an error about a stream that ended too early, with the explanation of the server if there is one. */
async function refuseShort(
  address: string,
  signal: AbortSignal,
  found: number,
  total: number,
): Promise<never> {
  const problem = await fetch(new URL('problem', new URL(address, self.location.href)), { signal }).catch(
    () => null,
  );
  const words = problem?.ok ? await problem.text() : '';
  throw words
    ? new Failure('file', 'volume', words, 'a complete volume')
    : new Failure('file', 'volume', `${found} bytes`, `${total} bytes`, 'open it again');
}

/** Conversion of voxels to types that the engine supports. */
interface Narrowed {
  readonly dtype: string;
  readonly bytesPerVoxel: number;
  /** Converts the bytes of complete voxels to the type `dtype`. */
  readonly narrow: (bytes: Uint8Array) => Uint8Array;
}

const AS_THEY_ARE: Readonly<Record<string, number>> = { uint8: 1, int16: 2, uint16: 2, float32: 4 };

/** Types that are converted: those of one byte exactly, wider ones to the 24 bits of a float32. */
const OTHERS = {
  int8: { From: Int8Array, To: Int16Array, dtype: 'int16' },
  int32: { From: Int32Array, To: Float32Array, dtype: 'float32' },
  uint32: { From: Uint32Array, To: Float32Array, dtype: 'float32' },
  float64: { From: Float64Array, To: Float32Array, dtype: 'float32' },
} as const;

export function narrowed(dtype: string): Narrowed {
  const bytesPerVoxel = Object.hasOwn(AS_THEY_ARE, dtype) ? AS_THEY_ARE[dtype] : undefined;
  if (bytesPerVoxel !== undefined) {
    return { dtype, bytesPerVoxel, narrow: (bytes) => bytes };
  }
  if (!Object.hasOwn(OTHERS, dtype)) {
    const expected = [...Object.keys(AS_THEY_ARE), ...Object.keys(OTHERS)].join(', ');
    throw new Failure('volume', 'type of the voxels', dtype, expected);
  }
  const { From, To, dtype: becomes } = OTHERS[dtype as keyof typeof OTHERS];
  const narrow = (bytes: Uint8Array) => {
    const voxels = new From(bytes.slice().buffer as ArrayBuffer);
    return new Uint8Array(To.from(voxels).buffer);
  };
  return { dtype: becomes, bytesPerVoxel: From.BYTES_PER_ELEMENT, narrow };
}
