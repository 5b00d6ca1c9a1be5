/** The page's readers against Python's, on made files and on real ones. */
import { describe, expect, test } from 'vitest';
import { openMedia } from './opened';
import { type Expected, expectedOf, refusedLike, sameVolume } from './truth';

const volumes = expectedOf('volume');

describe.skipIf(volumes.length === 0)('volumes', () => {
  test.each(volumes.map((one) => [one.name, one] as const))('%s', async (_, expected: Expected) => {
    const opened = await openMedia(expected.path, expected.folder);
    if (expected.found !== undefined) {
      refusedLike(opened, expected);
    } else {
      sameVolume(opened, expected);
    }
  });
});
