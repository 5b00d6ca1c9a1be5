/** Damaged compressed slices are read or rejected. They never hang the reader or affect the next series. */
import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { changed, file } from './made';
import { below, openSources } from './opened';
import { everyTruth, sameVolume } from './truth';

const packed = everyTruth().filter(
  (truth) => /^(RLE|JPEG|HTJ2K)/.test(truth.name) && truth.found === undefined,
);
const LONGEST = 60_000;
const PLACES = 60;

describe.skipIf(packed.length === 0)('damaged pixels', { timeout: LONGEST }, () => {
  test.each(packed.map((truth) => ({ truth, name: truth.name })))('$name', async ({ truth }) => {
    const sources = below(truth.path);
    const [first] = sources;
    const bytes = readFileSync(`${truth.folder}/../${first?.path}`);
    for (let i = 0; i < PLACES; i += 1) {
      const at = bytes.length - 1 - Math.floor((i / PLACES) ** 2 * (bytes.length - 1000));
      for (const odd of [changed(bytes, at), bytes.subarray(0, at)]) {
        const begun = performance.now();
        const { failure } = await openSources([file(first?.path ?? '', odd), ...sources.slice(1)]);
        expect(failure?.kind, failure?.message).not.toBe('unexpected');
        expect(performance.now() - begun).toBeLessThan(5000);
      }
    }
    const whole = await openSources(sources, { wanted: truth.wanted ?? {} });
    if (truth.name !== 'JPEG extended, 12 bits') {
      sameVolume(whole, truth);
    }
  });
});
