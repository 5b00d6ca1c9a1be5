/** The page's readers against Python's, on made files and on real ones. */
import { statSync } from 'node:fs';
import { relative } from 'node:path';
import { describe, expect, test } from 'vitest';
import { below, openSources, type Result, sourceOf } from './opened';
import { type Expected, everyTruth, refusedLike, sameVolume } from './truth';

const truths = everyTruth();

/** What Python reads and the page does not: there is no decoder of it that is free and small. */
const NOT_READ: Readonly<Record<string, RegExp>> = {
  'JPEG extended, 12 bits': /^JPEG Extended of 1\d bits$/,
};

/** Opens what Python read; files beside it may be named by it. */
function opened({ path, folder, kind, wanted = {} }: Expected): Promise<Result> {
  const isFolder = statSync(path).isDirectory();
  const sources = isFolder ? below(path) : [sourceOf(path, relative(`${folder}/..`, path))];
  return openSources(sources, { others: kind === 'volume' ? below(folder) : sources, wanted });
}

/** A series of real size takes seconds where the machine is busy. */
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
