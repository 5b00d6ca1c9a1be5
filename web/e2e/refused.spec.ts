/** A rejected click changes nothing. The page reports what was found, what was expected, and where. */
import { expect, test } from '@playwright/test';
import { button, expectBegun, rows, startTracing, traced } from './controls';
import { Viewer } from './page';
import { BONE, clickAt, NARROWED, openScan, STRAIGHT, traceTube, tubes } from './scans';

let viewer: Viewer;

test.beforeAll(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?device=cpu', { viewport: { width: 1100, height: 720 } });
  await openScan(viewer, tubes('tubes.nrrd'));
  await startTracing(viewer);
  await traceTube(viewer, NARROWED, [25, 10], 1);
});
test.afterEach(() => viewer.expectNoFault());
test.afterAll(() => viewer.close());

const length = () => rows(viewer).first().locator('.length').textContent();
const lastStep = () => button(viewer, 'Undo').getAttribute('title');

async function expectRefused(click: () => Promise<void>, words: RegExp, mark: RegExp): Promise<void> {
  const before = [await length(), await lastStep(), await rows(viewer).count()];
  await click();
  await expect(viewer.problem).toContainText(words);
  await expect(viewer.problem).toContainText(/Found .*; expected .*\./);
  await expect(viewer.page.locator('[data-place=weakest]')).toHaveCount(4);
  for (const pane of ['axial', 'coronal', 'sagittal'] as const) {
    await expect(viewer.pane(pane)).toContainText(mark);
  }
  expect([await length(), await lastStep(), await rows(viewer).count()]).toEqual(before);
}

const bridge = () => viewer.problem.getByRole('button', { name: 'Bridge the gap' });

test('in air', async () => {
  await expectRefused(
    () => clickAt(viewer, [0, 10]),
    /Found fat, about -100 around it; expected lumen/,
    /here: -100/,
  );
  await expect(bridge()).toHaveCount(0);
  await viewer.screenshot('refused-air');
});

test('in bone', async () => {
  await expectRefused(
    () => clickAt(viewer, [0, BONE], 'axial'),
    /Found bone, metal or calcium, about 1100 around it; expected lumen/,
    /here: 1100/,
  );
  await expect(bridge()).toHaveCount(0);
  await viewer.screenshot('refused-bone');
});

test('in a vessel that does not meet the other one, which can be bridged', async () => {
  await expectRefused(
    () => clickAt(viewer, [STRAIGHT, 0], 'axial'),
    /Found \d+\.\d mm between them that do not look like lumen, least at .*; expected lumen/,
    /least lumen-like point: -\d+/,
  );
  await viewer.screenshot('refused-apart');
  await expect(viewer.problem.getByRole('button', { name: 'Add a point between' })).toBeVisible();
  await bridge().click();
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /bridge gaps/);
  await expect(viewer.problem).toHaveCount(0);
  await expect(viewer.page.getByLabel('Bridge gaps without lumen')).toBeChecked();
  await expect.poll(async () => Number.parseFloat((await length()) ?? '')).toBeGreaterThan(30);
  await viewer.press('Control+z');
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /begin a vessel/);
});

test('as the first click of a vessel, at once', async () => {
  await button(viewer, 'End this vessel').click();
  await expectRefused(() => clickAt(viewer, [0, 10]), /Found fat, about -100 around it/, /here: -100/);
  await expect(viewer.page.locator('[data-place=first]')).toHaveCount(0);
});

test('also as its first two clicks; once bridged, that vessel can be extended', async () => {
  await clickAt(viewer, [STRAIGHT, -15]);
  await expectBegun(viewer);
  await expect(viewer.problem).toHaveCount(0);
  await expect(viewer.page.locator('[data-place=weakest]')).toHaveCount(0);
  await clickAt(viewer, [NARROWED, -15]);
  await expect(rows(viewer)).toHaveCount(1);
  await bridge().click();
  await traced(viewer, 2);
  // The page calls the bridged part a guess.
  await expect(viewer.page.locator('.trace-bar')).toContainText(
    /Vessel 2, 27\.\d mm\. Doubtful from .*guess\./,
  );
  await expect(viewer.page.locator('[data-place=first]')).toHaveCount(0);
  await viewer.rest();
  await viewer.screenshot('refused-bridged');
});
