/** What the page keeps of the DICOM study of a series, to save objects in this study. */
import { expect, test } from 'vitest';
import { series } from '../e2e/dicom';
import { headOf, studyOf } from '../src/io/dicom';
import { type ExaminedFile, examine } from '../src/io/dicom/headers';
import type { Plan } from '../src/io/dicom/judging';
import { Recorder } from '../src/io/dicom/records';
import { BlobSource } from '../src/io/source';

const sources = series([0, 2, 4]).map(
  ({ name, buffer }) => new BlobSource(name, new Blob([new Uint8Array(buffer)])),
);
const read = (): Promise<ExaminedFile[]> =>
  Promise.all(sources.map((source) => examine(source, new Recorder({ SOPInstanceUID: [] }))));
const plan = {
  slices: [{ file: 1 }, { file: 2 }],
  patient: { id: 'A1', issuer: 'Ward' },
  details: { modality: 'CT' },
} as unknown as Plan;

test('it contains the header of one slice without pixels, and the UIDs of all slices that were read', async () => {
  const study = await studyOf(plan, await read());
  expect(study?.instances).toEqual(['1.2.3.2.0', '1.2.3.4.0']);
  expect(study?.studyCount).toBe(1);
  expect(study?.identity).toEqual({ patient: 'A1', issuer: 'Ward', modality: 'CT' });
  const whole = await sources[1]?.slice(0, 1 << 20);
  const pixels = 16 * 16 * 2;
  expect(study?.header).toEqual(whole?.subarray(0, whole.length - pixels));
});

test('the number of studies is counted', async () => {
  const [first, second, third] = await read();
  const other = third?.image ? [{ ...third, image: { ...third.image, study: '1.2.9' } }] : [];
  const files = [...[first, second].filter((one) => one !== undefined), ...other];
  expect((await studyOf(plan, files))?.studyCount).toBe(2);
});

test('a file that is not DICOM is rejected', async () => {
  const source = new BlobSource('lines.csv', new Blob(['x,y,z']));
  await expect(headOf(source)).rejects.toThrow('lines.csv: found no DICOM');
});
