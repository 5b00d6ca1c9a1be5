/** Tests of tracing by clicks and keys, and of editing, undoing, saving and opening the vessels. */
import { readFileSync } from 'node:fs';
import { expect, type Locator, test } from '@playwright/test';
import { button, listAsTheyCame, nameOf, rename, rows, SIZE, untraced } from './controls';
import { type PaneName, Viewer } from './page';

const lengthOf = async (viewer: Viewer, n: number): Promise<number> =>
  Number.parseFloat((await rows(viewer).nth(n).locator('.length').textContent()) ?? '');
const point = (viewer: Viewer, n: number, pane: PaneName = 'coronal'): Locator =>
  viewer.pane(pane).getByRole('button', { name: new RegExp(`^Point ${n} of`) });

/** Position in a slice of the phantom "junction", in units of the height of the pane, which the volume fills. */
async function place(viewer: Viewer, across: number, down: number, pane: PaneName = 'coronal') {
  const [width, height] = await viewer.size(pane);
  return [Math.round(width / 2 + across * height), Math.round(down * height)] as const;
}

const TRUNK = [0, 0.8] as const;
const RIGHT = [-0.19, 0.22] as const;
const LEFT = [0.19, 0.22] as const;

async function click(viewer: Viewer, [across, down]: readonly [number, number]): Promise<void> {
  await viewer.click(await place(viewer, across, down), 'coronal');
}

async function startTool(viewer: Viewer): Promise<void> {
  await viewer.page.locator('main').click({ position: { x: 3, y: 3 }, trial: true });
  await viewer.page.locator('header').getByRole('button', { name: 'Trace', exact: true }).click();
  await expect(viewer.pane('coronal')).toBeVisible();
  await viewer.rest();
}

async function traceTo(viewer: Viewer, end: readonly [number, number], count: number): Promise<void> {
  await click(viewer, TRUNK);
  await click(viewer, end);
  await expect(rows(viewer)).toHaveCount(count);
  await button(viewer, 'End this vessel').click();
}

test('a page without vessels offers three ways to get them; after tracing in a maximised slice, the cut is shown', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  const offer = viewer.page.locator('.trace-bar.offer');
  for (const words of ['Find all vessels', 'Trace one vessel', 'I have centerlines']) {
    const box = await offer.getByRole('button', { name: words }).boundingBox();
    expect(box?.height).toBeGreaterThanOrEqual(44);
  }
  const [chooser] = await Promise.all([
    viewer.page.waitForEvent('filechooser'),
    offer.getByRole('button', { name: 'I have centerlines' }).click(),
  ]);
  expect(chooser.isMultiple()).toBe(true);
  await button(viewer, 'Trace one vessel').click();
  await expect(viewer.page.locator('main')).toHaveAttribute('data-layout', 'four');
  await expect(viewer.field('Context')).toHaveValue('mip');
  await button(viewer, 'Done').click();
  await expect(viewer.page.locator('main')).toHaveAttribute('data-layout', 'strip');
  await expect(viewer.field('Context')).toHaveValue('mida');
  await startTool(viewer);
  await viewer.page.getByRole('button', { name: 'Show Coronal alone' }).click();
  await expect(viewer.pane()).toBeHidden();
  await button(viewer, 'Done').click();
  await expect(viewer.pane()).toBeVisible();
  await expect(viewer.page.locator('main')).toHaveAttribute('data-layout', 'strip');
  viewer.expectNoFault();
  await viewer.close();
});

test('by mouse: two clicks trace a vessel, a path preview leads to the pointer, and points are edited', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  await startTool(viewer);
  await click(viewer, TRUNK);
  const [x, y] = await viewer.place(await place(viewer, ...RIGHT), 'coronal');
  await viewer.page.mouse.move(x, y);
  for (const pane of ['turning', 'axial', 'coronal', 'sagittal'] as const) {
    await expect(viewer.pane(pane).locator('path.live')).toHaveCount(1);
    await expect(viewer.pane(pane).locator('path.live.missing')).toHaveCount(0);
  }
  await viewer.screenshot('trace-live');
  await click(viewer, RIGHT);
  await expect(nameOf(viewer, 0)).toHaveValue('Vessel 1');
  // From 1/5 of the height, the vessel runs along the trunk (30 mm long) into the other branch (36 mm long).
  await expect.poll(() => lengthOf(viewer, 0)).toBeGreaterThan(45);
  const whole = await lengthOf(viewer, 0);
  expect(whole).toBeLessThan(66);
  await button(viewer, 'End this vessel').click();

  // A click on the curve adds a point, which is dragged along the vessel and removed.
  const [middleX, middleY] = await viewer.place(await place(viewer, 0, 0.65), 'coronal');
  await viewer.page.mouse.click(middleX, middleY, { button: 'right' });
  await expect(point(viewer, 3)).toHaveCount(1);
  await viewer.page.mouse.move(middleX, middleY);
  const box = await point(viewer, 2).boundingBox();
  await viewer.page.mouse.move((box?.x ?? 0) + 6, (box?.y ?? 0) + 6);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(middleX + 3, middleY - 20, { steps: 5 });
  await viewer.page.mouse.up();
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /move a point/);
  await point(viewer, 2).click({ button: 'right' });
  await expect(point(viewer, 3)).toHaveCount(0);
  await expect.poll(() => lengthOf(viewer, 0)).toBeCloseTo(whole, 1);
  await viewer.press('Escape');
  await expect(viewer.page.locator('main')).toHaveAttribute('data-layout', 'strip');
  await viewer.rest();
  await viewer.screenshot('trace-done');
  await expect(viewer.readOut).toContainText(/Vessel 1|\d/);
  viewer.expectNoFault();
  await viewer.close();
});

test('if no lumen is under the pointer, a click in the projection must be confirmed in the slices', async ({
  browser,
}) => {
  const viewer = await untraced(browser, 'y_junction', { hasTouch: true });
  await startTool(viewer);
  // A finger cannot hover, so a tap only proposes the brightest point, as a candidate in all four views.
  await viewer.tap([0.5, 0.75]);
  await expect(viewer.page.locator('[data-place=candidate]')).toHaveCount(4);
  await expect(viewer.page.locator('[data-place=first]')).toHaveCount(0);
  await viewer.press('Escape');
  await expect(viewer.page.locator('[data-place=candidate]')).toHaveCount(0);
  await viewer.tap([0.5, 0.7]);
  await button(viewer, 'Set the point here').click();
  await expect(viewer.page.locator('[data-place=first]')).toHaveCount(4);
  await viewer.tap([0.5, 0.5]);
  await viewer.tap([0.5, 0.5]);
  await expect(rows(viewer)).toHaveCount(1);
  viewer.expectNoFault();
  await viewer.close();
});

test('by keys only: a vessel is traced, edited and saved', async ({ browser }) => {
  const viewer = await untraced(browser);
  const { page } = viewer;
  await viewer.press('t');
  await expect(viewer.pane('axial')).toBeVisible();
  await viewer.pane('axial').focus();
  await viewer.press('Enter');
  await expect(page.locator('[data-place=first]')).toHaveCount(4);
  for (let n = 0; n < 14; n++) {
    await viewer.press('PageDown');
  }
  await viewer.press('ArrowRight', 'ArrowLeft');
  await expect(viewer.pane('axial').locator('path.live')).toHaveCount(1);
  await viewer.press('Enter');
  await expect(rows(viewer)).toHaveCount(1);
  await viewer.press('Enter');
  await expect(button(viewer, 'End this vessel')).toHaveCount(0);
  await point(viewer, 2, 'axial').focus();
  await viewer.press('ArrowRight');
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /move a point/);
  await viewer.press('Control+z');
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /begin a vessel/);
  await viewer.press('Escape');
  await nameOf(viewer, 0).focus();
  await viewer.press('F2');
  await page.keyboard.type('by keys');
  await viewer.press('Tab');
  await expect(nameOf(viewer, 0)).toHaveValue('by keys');
  await button(viewer, 'Save .vtp').focus();
  const [download] = await Promise.all([page.waitForEvent('download'), viewer.press('Enter')]);
  expect(download.suggestedFilename()).toMatch(/-centerlines-[\d-]+\.vtp$/);
  viewer.expectNoFault();
  await viewer.close();
});

test('a vessel traced without clicks gets points, keeps its path, and is edited by these points', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu', { viewport: SIZE });
  await viewer.rest();
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(1);
  const before = await lengthOf(viewer, 0);
  await startTool(viewer);
  await expect(point(viewer, 1)).toHaveCount(0);
  const [x, y] = await viewer.place(await place(viewer, 0, 0.5), 'coronal');
  await viewer.page.mouse.click(x, y, { button: 'right' });
  // The vessel has five points: both ends, two between them, and the added one.
  await expect(point(viewer, 5)).toHaveCount(1);
  await expect(point(viewer, 6)).toHaveCount(0);
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /add a point/);
  await expect.poll(async () => Math.abs((await lengthOf(viewer, 0)) - before)).toBeLessThan(1);
  await viewer.screenshot('trace-taken');
  await point(viewer, 5).click({ button: 'right' });
  await expect.poll(async () => before - (await lengthOf(viewer, 0))).toBeGreaterThan(15);
  await viewer.press('Control+z', 'Control+z');
  await expect(point(viewer, 1)).toHaveCount(0);
  await expect.poll(() => lengthOf(viewer, 0)).toBe(before);
  viewer.expectNoFault();
  await viewer.close();
});

test('two vessels that meet are joined, cut and hidden, and saved files are opened again', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  const { page } = viewer;
  await startTool(viewer);
  await traceTo(viewer, RIGHT, 1);
  await traceTo(viewer, LEFT, 2);
  await button(viewer, 'Done').click();
  await listAsTheyCame(viewer);
  await rows(viewer).nth(0).getByRole('radio').check();
  await expect(nameOf(viewer, 0)).toHaveAttribute('list', 'names-to-offer');
  await expect(page.locator('#names-to-offer option[value="Left renal artery"]')).toHaveCount(1);
  await rename(viewer, 0, 'to the right');
  const lengths = [await lengthOf(viewer, 0), await lengthOf(viewer, 1)];
  for (const kind of ['vtp', 'mrk.json']) {
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      button(viewer, `Save .${kind}`).click(),
    ]);
    const bytes = readFileSync(await download.path());
    const file = { name: `again.${kind}`, mimeType: 'application/octet-stream', buffer: bytes };
    const count = await rows(viewer).count();
    await page.locator('aside input[type=file]').setInputFiles(file);
    await expect(rows(viewer)).toHaveCount(count + 2);
    await expect(nameOf(viewer, count)).toHaveValue('to the right');
    await expect.poll(() => lengthOf(viewer, count)).toBeCloseTo(lengths[0] ?? 0, 1);
    await expect.poll(() => lengthOf(viewer, count + 1)).toBeCloseTo(lengths[1] ?? 0, 1);
    await viewer.press('Control+z');
    await expect(rows(viewer)).toHaveCount(count);
  }
  await button(viewer, 'Hide to the right').click();
  await expect(rows(viewer).nth(1).getByRole('radio')).toBeChecked();
  await button(viewer, 'Show to the right').click();
  await rows(viewer).nth(0).getByRole('radio').check();
  await button(viewer, 'Cut here').click();
  await expect(rows(viewer)).toHaveCount(3);
  const parts = async () => (await lengthOf(viewer, 0)) + (await lengthOf(viewer, 1));
  await expect.poll(parts).toBeCloseTo(lengths[0] ?? 0, 0);
  await page.getByLabel('Join to the right with').selectOption({ index: 1 });
  await expect(rows(viewer)).toHaveCount(2);
  await expect.poll(() => lengthOf(viewer, 0)).toBeCloseTo(lengths[0] ?? 0, 0);
  viewer.expectNoFault();
  await viewer.close();
});

test('"All branches from here" finds those connected to the vessel at the cross-hair', {
  tag: '@long',
}, async ({ browser }) => {
  test.setTimeout(400_000);
  const viewer = await untraced(browser, 'aorta');
  // The user has not placed the cross-hair, so the next click is the seed.
  await viewer.press('b');
  await expect(viewer.page.getByRole('status').first()).toContainText('Click where the tree begins');
  await expect(rows(viewer)).toHaveCount(0);
  await viewer.press('Enter');
  await expect.poll(() => rows(viewer).count(), { timeout: 300_000 }).toBeGreaterThan(20);
  await viewer.screenshot('trace-branches');
  await viewer.press('Control+z');
  await expect(rows(viewer)).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});
