/** Gzip that the browser unpacks is read, or refused, as by the module with decoders. */
import { gzipSync } from 'node:zlib';
import { describe, expect, test } from 'vitest';
import { BlobSource } from '../src/io/source';
import { Unpacked, Unverified } from '../src/io/unpacked';
import { file, nifti } from './made';
import { openSources } from './opened';

const RAMP = Array.from({ length: 105 }, (_, i) => i);
const long = Buffer.concat([nifti(), Buffer.from('what follows the voxels')]);

const unpacked = (bytes: Uint8Array, first = 0) =>
  Unpacked.of(new BlobSource('a', new Blob([new Uint8Array(bytes)])), first);

async function finished(content: Unpacked | null): Promise<boolean> {
  try {
    await content?.finish(async () => undefined);
    return content !== null;
  } catch (error) {
    expect(error).toBeInstanceOf(Unverified);
    return false;
  }
}

describe('gzip', { timeout: 120_000 }, () => {
  test('no flipped bit (of every third one) changes voxels', async () => {
    const whole = gzipSync(long);
    let count = 0;
    for (let bit = 0; bit < 8 * whole.length; bit += 3) {
      const bytes = Buffer.from(whole);
      bytes[bit >> 3] = (bytes[bit >> 3] ?? 0) ^ (1 << (bit & 7));
      const { memory, failure } = await openSources([file('v.nii.gz', bytes)]);
      if (failure === null) {
        expect([...memory.values], `bit ${bit}`).toEqual(RAMP);
        count += 1;
      } else {
        expect(failure.kind, failure.message).toBe('format');
      }
    }
    expect(count).toBeLessThan(100);
  });

  test('streams of several parts and bytes after the stream are read', async () => {
    const parts = [gzipSync(long.subarray(0, 400)), gzipSync(long.subarray(400)), Buffer.from('rest')];
    for (const bytes of [Buffer.concat(parts), Buffer.concat(parts.slice(0, 2)), gzipSync(long)]) {
      const { memory, failure } = await openSources([file('v.nii.gz', bytes)]);
      expect(failure).toBeNull();
      expect([...memory.values]).toEqual(RAMP);
    }
  });

  test('only a single whole stream counts as verified', async () => {
    const whole = gzipSync(long);
    expect(await finished(await unpacked(whole))).toBe(true);
    expect(await finished(await unpacked(Buffer.concat([Buffer.from('head'), whole]), 4))).toBe(true);
    const damaged = Buffer.from(whole);
    damaged[whole.length - 6] = (damaged[whole.length - 6] ?? 0) ^ 1;
    const others = [damaged, whole.subarray(0, -1), Buffer.concat([whole, Buffer.from('rest')]), long];
    for (const bytes of [...others, Buffer.concat([whole, whole]), gzipSync(Buffer.alloc(99_999))]) {
      expect(await finished(await unpacked(bytes))).toBe(false);
    }
  });

  test('content is given from any byte on', async () => {
    const content = await unpacked(gzipSync(long));
    for (const start of [0, 300, 352, 10, long.length - 1]) {
      expect(await content?.slice(start, start + 9)).toEqual(new Uint8Array(long.subarray(start, start + 9)));
    }
    await content?.close();
  });
});
