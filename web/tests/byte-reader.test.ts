import { expect, test } from 'vitest';
import { ByteReader } from '../src/worker/byte-reader';

const WHOLE = Uint8Array.from({ length: 9 }, (_, n) => n + 1);

function streamOf(parts: readonly Uint8Array[]): ReadableStream<Uint8Array> {
  return new ReadableStream({
    start(controller) {
      for (const part of parts) {
        controller.enqueue(part);
      }
      controller.close();
    },
  });
}

/** The bytes in pieces: cut after byte n if bit n of `cuts` is set. */
function split(cuts: number): Uint8Array[] {
  const ends = [...Array(8).keys()].filter((n) => cuts & (1 << n)).map((n) => n + 1);
  return [...ends, 9].map((end, n) => WHOLE.slice(n === 0 ? 0 : (ends[n - 1] ?? 0), end));
}

test('a stream gives the same pieces however it is split', async () => {
  for (let cuts = 0; cuts < 256; cuts++) {
    const reader = new ByteReader(streamOf(split(cuts)));
    expect([...(await reader.take(4))]).toEqual([1, 2, 3, 4]);
    expect([...(await reader.take(0))]).toEqual([]);
    expect([...(await reader.take(4))]).toEqual([5, 6, 7, 8]);
    expect([...(await reader.take(4))]).toEqual([9]);
    expect([...(await reader.take(4))]).toEqual([]);
    expect(reader.count).toBe(9);
  }
});

test('complete voxels come in order, and an incomplete one at the end remains', async () => {
  for (let cuts = 0; cuts < 256; cuts++) {
    const reader = new ByteReader(streamOf(split(cuts)));
    const taken: number[] = [];
    for (let part = await reader.takeWhole(2); part.length > 0; part = await reader.takeWhole(2)) {
      expect(part.length % 2).toBe(0);
      taken.push(...part);
    }
    expect(taken).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
    expect(reader.count).toBe(8);
  }
});

test('empty parts do not end a stream', async () => {
  const reader = new ByteReader(
    streamOf([new Uint8Array(), WHOLE.slice(0, 1), new Uint8Array(), WHOLE.slice(1)]),
  );
  expect([...(await reader.take(2))]).toEqual([1, 2]);
  expect([...(await reader.takeWhole(7))]).toEqual([3, 4, 5, 6, 7, 8, 9]);
});

test('an error of the stream is reported', async () => {
  const broken = new ReadableStream<Uint8Array>({
    start: (controller) => controller.error(new Error('the line is cut')),
  });
  await expect(new ByteReader(broken).take(1)).rejects.toThrow('the line is cut');
});

test('returned bytes are a copy', async () => {
  const part = WHOLE.slice();
  const reader = new ByteReader(streamOf([part]));
  const taken = await reader.take(3);
  part.fill(0);
  expect([...taken]).toEqual([1, 2, 3]);
});
