/** The readers of the page give the same results as those of the Python package, on synthetic and real files. */
import { readFileSync, statSync } from 'node:fs';
import { relative } from 'node:path';
import { describe, expect, test } from 'vitest';
import { changed, file } from './made';
import { below, openSources, type Result, sourceOf } from './opened';
import { type Expected, everyTruth, refusedLike, sameVolume } from './truth';

const truths = everyTruth();

/** Formats that only the Python package reads, since there is no small free decoder for browsers. */
const NOT_READ: Readonly<Record<string, RegExp>> = {
  'JPEG extended, 12 bits': /^JPEG Extended of 1\d bits$/,
};

/** Opens the file that Python has read; it may refer to other files in its folder. */
function opened({ path, folder, kind, wanted = {} }: Expected): Promise<Result> {
  const isFolder = statSync(path).isDirectory();
  const sources = isFolder ? below(path) : [sourceOf(path, relative(`${folder}/..`, path))];
  return openSources(sources, { others: kind === 'volume' ? below(folder) : sources, wanted });
}

describe.skipIf(truths.length === 0)('read as Python reads', () => {
  test.each(truths.map((truth) => ({ truth, name: truth.name })))('$name', async ({ truth }) => {
    const result = await opened(truth);
    const words = NOT_READ[truth.name];
    if (words) {
      expect(result.failure?.found).toMatch(words);
    } else if (truth.found === undefined) {
      sameVolume(result, truth);
    } else {
      refusedLike(result, truth);
    }
  });
});

/** Damaged compressed slices are read or rejected. They never hang the reader or affect the next series. */
const packed = truths.filter((truth) => /^(RLE|JPEG|HTJ2K)/.test(truth.name) && truth.found === undefined);
const PLACES = process.env.LUMENCUT_LONG ? 20 : 8;

describe.skipIf(packed.length === 0)('damaged pixels', () => {
  test.each(packed.map((truth) => ({ truth, name: truth.name })))('$name', async ({ truth }) => {
    const sources = below(truth.path);
    const [first] = sources;
    const bytes = readFileSync(`${truth.folder}/../${first?.path}`);
    for (let i = 0; i < PLACES; i += 1) {
      const at = bytes.length - 1 - Math.floor((i / PLACES) ** 2 * (bytes.length - 1000));
      for (const odd of [changed(bytes, at), bytes.subarray(0, at)]) {
        const { failure } = await openSources([file(first?.path ?? '', odd), ...sources.slice(1)]);
        expect(failure?.kind, failure?.message).not.toBe('unexpected');
      }
    }
    const whole = await openSources(sources, { wanted: truth.wanted ?? {} });
    if (truth.name !== 'JPEG extended, 12 bits') {
      sameVolume(whole, truth);
    }
  });
});
