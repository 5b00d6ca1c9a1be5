/** Bone is hidden around the cut and in MIPs by one button, and undone like anything. Vessels keep all their pixels. */
import { type Browser, type BrowserContextOptions, expect, test } from '@playwright/test';
import { button, choose, fileOf, SESSION, saved } from './controls';
import { Viewer } from './page';
import { brightness, NARROWED, openScan, STRAIGHT, tubes, vertebra } from './scans';

const SIZE = { width: 1000, height: 640 };
const SCAN = tubes('tubes.nrrd', 0, vertebra);

/** The scan as a MIP seen from the front: two vessels, and bone behind and between them. */
async function shownAsMip(browser: Browser, options: BrowserContextOptions = {}): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE, ...options });
  await openScan(viewer, SCAN);
  await button(viewer, 'MIP').click();
  await viewer.look('1', 'R', 'S');
  return viewer;
}

const atAll = async (viewer: Viewer): Promise<number[]> => {
  const found: number[] = [];
  for (const x of [NARROWED, 0, STRAIGHT]) {
    found.push(await brightness(viewer, x));
  }
  return found;
};

const hidden = (viewer: Viewer) => viewer.page.getByRole('button', { name: 'Hide bone', pressed: true });

test('bone disappears, vessels stay, and undo and redo switch between both', async ({ browser }) => {
  const viewer = await shownAsMip(browser);
  const [before, slice] = [await atAll(viewer), await viewer.pixels('axial')];
  await button(viewer, 'Hide bone').click();
  await expect(hidden(viewer)).toBeVisible();
  const after = await atAll(viewer);
  await viewer.screenshot('bone-hidden');
  expect([after[0], after[2]]).toEqual([before[0], before[2]]);
  expect(after[1]).toBeLessThan((before[1] ?? 0) / 2);
  expect((await viewer.pixels('axial')).bytes, 'slices show the scan itself').toEqual(slice.bytes);
  await viewer.press('Control+z');
  await expect(hidden(viewer)).toHaveCount(0);
  expect(await atAll(viewer)).toEqual(before);
  await viewer.press('Control+Shift+Z');
  await expect(hidden(viewer)).toBeVisible();
  expect(await atAll(viewer)).toEqual(after);
  viewer.expectNoFault();
  await viewer.close();
});

test('the keyboard hides bone, and a session keeps it hidden', { tag: '@long' }, async ({ browser }) => {
  const viewer = await shownAsMip(browser);
  await button(viewer, 'Hide bone').focus();
  await viewer.press('Enter');
  await expect(hidden(viewer)).toBeVisible();
  const after = await atAll(viewer);
  const session = await saved(viewer, SESSION);
  const content = JSON.parse(session.toString('utf-8')).LumencutSession;
  expect([content.format, content.bone_hidden]).toEqual([2, true]);
  await viewer.page.reload();
  await openScan(viewer, SCAN);
  await expect(hidden(viewer)).toHaveCount(0);
  await choose(viewer, fileOf('saved.mrk.json', session));
  await expect(hidden(viewer)).toBeVisible();
  expect(await atAll(viewer)).toEqual(after);
  viewer.expectNoFault();
  await viewer.close();
});

test('a tap hides bone', { tag: '@long' }, async ({ browser }) => {
  const viewer = await shownAsMip(browser, { hasTouch: true });
  await button(viewer, 'Hide bone').tap();
  await expect(hidden(viewer)).toBeVisible();
  viewer.expectNoFault();
  await viewer.close();
});
