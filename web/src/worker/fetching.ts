/** Loads a study of the same origin: the stream of voxels that `lumencut view` serves, and a file of centerlines. */
import { Failure } from '../core/failure';
import type { Progress } from '../core/messages';
import type { Engine } from '../core/module';
import { ByteReader } from './byte-reader';
import { narrowed } from './narrowed';

export type Told = (progress: Progress) => void;

const MAGIC = 'LCVOLUME';
/** The longest header that is believed (bytes). */
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
}

/** Loads volume and centerlines one after the other; tells what was odd, and the name of the volume. */
export async function fetchStudy(
  engine: Engine,
  addresses: Addresses,
  told: Told,
  signal: AbortSignal,
): Promise<{ notes: string[]; name: string }> {
  const notes: string[] = [];
  let name = '';
  if (addresses.volume !== null) {
    const header = await fetchVolume(engine, addresses.volume, told, signal);
    notes.push(...(header.notes ?? []));
    name = header.name ?? '';
  } else {
    engine.close();
  }
  if (addresses.centerlines !== null) {
    told({ words: 'Centerlines', done: 0, total: null });
    const response = await answered(addresses.centerlines, signal);
    const bytes = new Uint8Array(await response.arrayBuffer());
    const file = new URL(response.url).pathname.split('/').pop() ?? 'centerlines';
    notes.push(...(JSON.parse(engine.open_centerlines(bytes, file)) as string[]));
  }
  return { notes, name };
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
        `an answer ${response.status}`,
        'a file',
        'look at the program that serves the page',
      )
    : failure;
}

async function fetchVolume(
  engine: Engine,
  address: string,
  told: Told,
  signal: AbortSignal,
): Promise<Header> {
  const response = await answered(address, signal);
  if (!response.body) {
    throw new Failure('file', address, 'an answer without content', 'a volume');
  }
  const bytes = new ByteReader(response.body);
  const header = await readHeader(bytes, address);
  const total = await readVoxels(engine, bytes, header, told);
  if (bytes.count < total) {
    await refuseShort(address, signal, bytes.count, total);
  }
  return header;
}

async function readHeader(bytes: ByteReader, address: string): Promise<Header> {
  const start = await bytes.take(12);
  const magic = new TextDecoder().decode(start.subarray(0, 8));
  const length = start.length === 12 ? new DataView(start.buffer, start.byteOffset).getUint32(8, true) : 0;
  if (magic !== MAGIC || length === 0 || length > LONGEST_HEADER) {
    throw new Failure(
      'format',
      address,
      'another file',
      'a stream of voxels',
      'drop the file on the page instead',
    );
  }
  return checkedHeader(new TextDecoder().decode(await bytes.take(length)));
}

/** The header of a text of JSON; the engine checks the numbers in it. */
function checkedHeader(text: string): Header {
  const read = parsed(text);
  const isWhole =
    Array.isArray(read?.size) &&
    read.size.length === 3 &&
    typeof read.dtype === 'string' &&
    read.world_from_index;
  if (!read || !isWhole) {
    const found = read ? `only ${Object.keys(read).join(', ') || 'an empty one'}` : 'a text that is no JSON';
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

/** Hands the voxels to the engine as they come; tells how many bytes there should be in all. */
async function readVoxels(engine: Engine, bytes: ByteReader, header: Header, told: Told): Promise<number> {
  const { dtype, narrow, bytesPerVoxel } = narrowed(header.dtype);
  const voxels = header.size[0] * header.size[1] * header.size[2];
  const total = bytes.count + voxels * bytesPerVoxel;
  engine.begin_volume(JSON.stringify({ ...header, dtype }));
  let offset = 0;
  for (;;) {
    const part = await bytes.takeWhole(bytesPerVoxel);
    if (part.length === 0) {
      return total;
    }
    const stored = narrow(part);
    engine.take_voxels(offset, stored);
    offset += stored.length;
    told({ words: 'Volume', done: bytes.count, total });
  }
}

/** The stream ended early: the server's words why, where it has some. */
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
    ? new Failure('file', 'volume', words, 'a whole volume')
    : new Failure('file', 'volume', `${found} bytes`, `${total}`, 'open it again');
}
