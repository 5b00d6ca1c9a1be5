/** For a rejected DICOM series, the page offers buttons that fix the problem. */
import { expect, test } from '@playwright/test';
import { series } from './dicom';
import { Viewer } from './page';

let viewer: Viewer;

test.beforeEach(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?device=cpu&test=1');
});
test.afterEach(async () => {
  viewer.expectNoFault();
  await viewer.close();
});

async function choose(files: ReturnType<typeof series>): Promise<void> {
  await viewer.page.locator('input[type=file]').first().setInputFiles(files);
}

async function mended(words: RegExp, button: string): Promise<readonly number[] | undefined> {
  await expect(viewer.problem).toContainText(words);
  await expect(viewer.problem).not.toContainText(/=True|`\w+`/);
  await viewer.problem.getByRole('button', { name: button, exact: true }).click();
  await expect(viewer.problem).toBeHidden();
  await viewer.rest();
  return (await viewer.report()).volume?.size;
}

test('missing slices are interpolated', async () => {
  await choose(series([0, 2, 4, 8, 10, 12]));
  const words = /Add the missing files, or interpolate the missing slices\./;
  expect(await mended(words, 'Interpolate the missing slices')).toEqual([16, 16, 7]);
});

test('uneven slices are put on a regular grid', async () => {
  await choose(series([0, 2, 4, 7, 10, 13]));
  const words = /Put the slices on a regular grid\./;
  expect(await mended(words, 'Put the slices on a regular grid')).toEqual([16, 16, 14]);
});

test('one of several phases is read', async () => {
  await choose(series([0, 2, 4, 6], 2));
  expect(await mended(/Choose one of the phases\./, 'Read the phase 400')).toEqual([16, 16, 4]);
});

test('among several series each shows its middle slice, and one is read by its button', async () => {
  const other = { uid: '1.2.4', number: '9' };
  await choose([...series([0, 2, 4, 6]), ...series([0, 2, 4, 6, 8], 1, other)]);
  const buttons = viewer.problem.getByRole('list', { name: 'Series' }).getByRole('button');
  await expect(buttons).toHaveCount(2);
  await expect(viewer.problem.getByTestId('series-thumbnail')).toHaveCount(2);
  await viewer.screenshot('series');
  await buttons.filter({ hasText: /^9: / }).click();
  await expect(viewer.problem).toBeHidden();
  await viewer.rest();
  expect((await viewer.report()).volume?.size).toEqual([16, 16, 5]);
});

test('a note reports points in the wrong order, and a button orders them', async () => {
  await choose(series([0, 2, 4, 6, 8, 10]));
  await viewer.rest();
  const [corner, far] = await viewer.report().then(({ volume }) => [volume?.corners[0], volume?.corners[7]]);
  const at = (n: number) =>
    (corner ?? []).map((low, axis) => low + (((far ?? [])[axis] ?? 0) - low) * (0.2 + n / 100));
  const order = [...Array(48).keys()].map((n) => at((n + 2) % 48));
  const line = (points: readonly (readonly number[])[]) => ({
    name: 'line.mrk.json',
    mimeType: 'application/json',
    buffer: Buffer.from(
      JSON.stringify({
        markups: [
          {
            type: 'Curve',
            coordinateSystem: 'LPS',
            coordinateUnits: 'mm',
            controlPoints: points.map((position) => ({ position, positionStatus: 'defined' })),
          },
        ],
      }),
    ),
  });
  await choose([line(order)]);
  await viewer.rest();
  const notes = viewer.page.locator('details', { hasText: 'wrong order' });
  const length = async () => (await viewer.report()).vessels?.map((vessel) => Math.round(vessel.length));
  const [disordered] = (await length()) ?? [];
  await notes.locator('summary').click();
  await notes.getByRole('button', { name: 'Put the points in order' }).click();
  await viewer.rest();
  const ordered = await length();
  expect(ordered).toHaveLength(1);
  expect(ordered?.[0]).toBeLessThan((disordered ?? 0) * 0.6);
  await expect(viewer.page.getByRole('button', { name: 'Put the points in order' })).toHaveCount(0);
});
