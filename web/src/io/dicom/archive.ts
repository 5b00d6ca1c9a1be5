/** Members of a zip archive. Each is unpacked into memory on demand, and rejected if larger than the archive states. */
import { configure, type FileEntry, Reader, ZipReader } from '@zip.js/zip.js/lib/zip-core-custom.js';
import { Failure } from '../../core/failure';
import type { Bytes, Source } from '../source';
import { damaged, formatFailure, printable } from '../words';

/** Unpacked size that is always allowed (bytes). Above it the ratio applies, which real slices never reach. */
const ALWAYS_ALLOWED = 2 ** 30;
const RATIO = 200;

// The content security policy forbids workers from blobs; this code already runs in a worker.
configure({ useWebWorkers: false });

export async function membersOf(archive: Source): Promise<Source[]> {
  const entries = (await entriesOf(archive)).filter((entry): entry is FileEntry => !entry.directory);
  if (entries.some((entry) => entry.encrypted)) {
    throw formatFailure(
      archive.path,
      'an encrypted archive',
      'an archive without a password',
      'unpack it first',
    );
  }
  const claimed = entries.reduce((sum, entry) => sum + entry.uncompressedSize, 0);
  if (claimed > Math.max(ALWAYS_ALLOWED, RATIO * archive.size)) {
    const found = `an archive of ${archive.size} bytes that claims to unpack to ${claimed} bytes`;
    throw formatFailure(
      archive.path,
      found,
      `at most ${RATIO} times the size of the archive`,
      'unpack it first',
    );
  }
  const members = entries.map((entry) => new Member(archive.path, entry));
  return members.sort((one, other) => (one.path < other.path ? -1 : 1));
}

async function entriesOf(archive: Source) {
  try {
    return await new ZipReader(new SourceReader(archive)).getEntries();
  } catch (error) {
    throw error instanceof Failure ? error : damaged(archive.path, 'a damaged archive', 'an intact one');
  }
}

class SourceReader extends Reader<Source> {
  constructor(private readonly source: Source) {
    super(source);
    this.size = source.size;
  }

  override readUint8Array(index: number, length: number): Promise<Uint8Array> {
    return this.source.slice(index, index + length);
  }
}

class Member implements Source {
  readonly path: string;

  constructor(
    archive: string,
    private readonly entry: FileEntry,
  ) {
    this.path = `${archive}/${printable(entry.filename)}`;
  }

  get size(): number {
    return this.entry.uncompressedSize;
  }

  async slice(start: number, end: number): Promise<Bytes> {
    const stopAt = Math.max(Math.min(end, this.size), 0);
    const wanted = new Uint8Array(Math.max(stopAt - start, 0));
    const stop = new AbortController();
    let count = 0;
    const sink = new WritableStream<Uint8Array>({
      write: (chunk) => {
        const part = chunk.subarray(Math.max(start - count, 0), Math.max(stopAt - count, 0));
        wanted.set(part, Math.max(count - start, 0));
        count += chunk.length;
        if (count >= stopAt && stopAt < this.size) {
          stop.abort();
        }
        if (count > this.size) {
          throw new Error('a file longer than the archive states');
        }
      },
    });
    try {
      await this.entry.getData(sink, { checkSignature: true, signal: stop.signal });
    } catch {
      if (!stop.signal.aborted) {
        throw damaged(this.path, 'a damaged member of the archive', 'an intact one');
      }
    }
    return wanted.subarray(0, Math.max(Math.min(count, stopAt) - start, 0));
  }
}
