/** The readers of the page give the same results as those of the Python package, on synthetic and real files. */
import { statSync } from 'node:fs';
import { relative } from 'node:path';
import { describe, expect, test } from 'vitest';
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

const LONGEST = 60_000;

describe.skipIf(truths.length === 0)('read as Python reads', { timeout: LONGEST }, () => {
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
