/** DICOM segmentations are recognised as masks, and their segments name the vessels. */
import { expect, test } from 'vitest';
import type { DocumentVessel } from '../src/core/messages';
import { isSegmentation, namedBySegment } from '../src/edit/segmentation';

const vessel = (name: string): DocumentVessel => ({
  id: 3,
  line: 7,
  name,
  color: '#fff',
  isHidden: false,
  clicks: null,
  doubt: null,
  contours: [],
});

const given = (name: string, ...words: readonly string[]) => ({
  path: name,
  file: new File([`${'\0'.repeat(128)}DICM`, ...words], name),
});

test.each([
  ['a segmentation', '1.2.840.10008.5.1.4.1.1.66.4\0', true],
  ['a label map', '1.2.840.10008.5.1.4.1.1.66.7\0', true],
  ['contours', '1.2.840.10008.5.1.4.1.1.481.3\0', true],
  ['a surface', '1.2.840.10008.5.1.4.1.1.66.5\0', false],
  ['a slice', '1.2.840.10008.5.1.4.1.1.2\0', false],
  ['a class of another root', '1.2.840.10008.5.1.4.1.1.66.4.1\0', false],
])('%s is told by its class', async (_, uid, isOne) => {
  expect(await isSegmentation([given('a.dcm', uid)])).toBe(isOne);
});

test('several files are not one segmentation', async () => {
  const one = given('a.dcm', '1.2.840.10008.5.1.4.1.1.66.4\0');
  expect(await isSegmentation([])).toBe(false);
  expect(await isSegmentation([one, one])).toBe(false);
});

test('vessels are named after their segments', () => {
  const several = { 1: 'aorta', 7: 'left renal artery' };
  expect(namedBySegment(vessel('label 7'), several).name).toBe('left renal artery');
  expect(namedBySegment(vessel('label 7 2'), several).name).toBe('left renal artery 2');
  expect(namedBySegment(vessel('label 9'), several).name).toBe('label 9');
  expect(namedBySegment(vessel('Mask 1'), { 5: 'aorta' }).name).toBe('aorta');
  expect(namedBySegment(vessel('Mask 1'), {}).name).toBe('Mask 1');
});
