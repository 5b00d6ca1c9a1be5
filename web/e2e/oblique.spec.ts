/** The planes of the slices are turned and moved by their lines in each other, by mouse, keys and touch. */
import { type Browser, type BrowserContextOptions, expect, type Locator, test } from '@playwright/test';
import type { Pair, Slices, Vector } from '../src/core/messages';

import { difference, isEmpty, SAME_CODE } from './compare';
import { choose, fileOf, SESSION, saved } from './controls';
import { type PaneName, Viewer } from './page';

type SlicePane = 'axial' | 'coronal' | 'sagittal';
const SLICES: readonly SlicePane[] = ['axial', 'coronal', 'sagittal'];
const SIZE = { width: 1100, height: 720 };
const STEP = Math.PI / 36;

async function opened(browser: Browser, options: BrowserContextOptions = {}): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu', { viewport: SIZE, ...options });
  await viewer.rest();
  await viewer.field('Layout').selectOption('four');
  for (const pane of SLICES) {
    await expect.poll(async () => isEmpty(await viewer.pixels(pane))).toBe(false);
  }
  return viewer;
}

const toggle = (viewer: Viewer): Locator =>
  viewer.pane('axial').getByRole('button', { name: 'Turn planes', exact: true });
const end = (viewer: Viewer, other: SlicePane, here: SlicePane): Locator =>
  viewer
    .pane(here)
    .getByRole('button', { name: `End of the line of the ${other} plane` })
    .last();
const line = (viewer: Viewer, other: SlicePane, here: SlicePane): Locator =>
  viewer
    .pane(here)
    .getByRole('button', { name: new RegExp(`^Line of the ${other}`) })
    .last();
const title = (viewer: Viewer, name: SlicePane): Locator => viewer.page.locator(`.pane.${name} .pane-title`);

async function middleOf(locator: Locator): Promise<Pair> {
  const box = await locator.boundingBox();
  if (!box) {
    throw new Error('it is not shown');
  }
  return [box.x + box.width / 2, box.y + box.height / 2];
}

async function slices(viewer: Viewer): Promise<Slices | undefined> {
  return (await viewer.state()).slices;
}

async function hairOf(viewer: Viewer, pane: PaneName): Promise<Pair> {
  const [box, [x, y]] = [await viewer.box(pane), await viewer.hair(pane)];
  return [box.x + x, box.y + y];
}

/** Where the end of a line lies after a turn about the cross-hair (radians, from right to down). */
async function turnedEnd(
  viewer: Viewer,
  grip: Locator,
  pane: PaneName,
  angle: number,
): Promise<[Pair, Pair]> {
  const [from, middle] = [await middleOf(grip), await hairOf(viewer, pane)];
  const [x, y] = [from[0] - middle[0], from[1] - middle[1]];
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [from, [middle[0] + x * cos - y * sin, middle[1] + x * sin + y * cos]];
}

async function dragTo(viewer: Viewer, [from, to]: readonly [Pair, Pair]): Promise<void> {
  const { mouse } = viewer.page;
  await mouse.move(...from);
  await mouse.down();
  await mouse.move(...from);
  await mouse.move(from[0] + 1, from[1]);
  await mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 });
  await mouse.move(...to, { steps: 3 });
}

const turnOf = (planes: Slices | undefined): number => {
  const [x, y] = planes?.coronal.right ?? ([1, 0, 0] as Vector);
  return Math.atan2(y, x);
};

test("a drag of a line's end turns both other planes, letters follow, and undo brings them back", async ({
  browser,
}) => {
  const viewer = await opened(browser);
  const before = await Promise.all(SLICES.map((pane) => viewer.pixels(pane)));
  await toggle(viewer).click();
  await expect(end(viewer, 'coronal', 'axial')).toBeVisible();
  await dragTo(viewer, await turnedEnd(viewer, end(viewer, 'coronal', 'axial'), 'axial', 0.6));
  await viewer.page.mouse.up();
  const planes = await slices(viewer);
  expect(Math.abs(turnOf(planes) - 0.6)).toBeLessThan(0.03);
  expect(planes?.axial).toEqual({ right: [1, 0, 0], down: [0, 1, 0] });
  await expect(title(viewer, 'axial')).toHaveText('Axial');
  await expect(title(viewer, 'coronal')).toHaveText('Coronal, oblique');
  await expect(title(viewer, 'sagittal')).toHaveText('Sagittal, oblique');
  await expect(viewer.pane('coronal').locator('.edge.left')).toHaveText('RA');
  await expect(viewer.pane('sagittal').locator('.edge.left')).toHaveText('AL');
  await viewer.rest();
  await viewer.screenshot('oblique-turned');
  const changed = async (n: number) =>
    difference(
      await viewer.pixels(SLICES[n] ?? 'axial'),
      before[n] ?? { width: 0, height: 0, bytes: Buffer.alloc(0) },
      SAME_CODE,
    );
  expect(await changed(0)).toBeNull();
  await expect.poll(() => changed(1)).not.toBeNull();
  await expect(viewer.page.getByRole('button', { name: 'Undo' })).toHaveAttribute('title', /turn the planes/);
  await viewer.press('Control+z');
  await expect(title(viewer, 'coronal')).toHaveText('Coronal');
  for (const n of [0, 1, 2]) {
    await expect.poll(() => changed(n)).toBeNull();
  }
  await viewer.press('Control+Shift+Z');
  await expect(title(viewer, 'coronal')).toHaveText('Coronal, oblique');
  await viewer.state();
  await viewer.page.reload();
  await viewer.rest();
  await expect(title(viewer, 'sagittal')).toHaveText('Sagittal, oblique');
  expect(await slices(viewer)).toEqual(planes);
  viewer.expectNoFault();
  await viewer.close();
});

test('a drag of a line moves its plane along its normal, and Escape puts back both', async ({ browser }) => {
  const viewer = await opened(browser);
  await viewer.press('x');
  const before = await viewer.hair('axial');
  const from = await middleOf(line(viewer, 'sagittal', 'axial'));
  await dragTo(viewer, [from, [from[0] + 60, from[1] + 25]]);
  await viewer.page.mouse.up();
  await expect.poll(async () => Math.abs((await viewer.hair('axial'))[0] - before[0] - 59)).toBeLessThan(3);
  expect(Math.abs((await viewer.hair('axial'))[1] - before[1])).toBeLessThan(0.6);
  const now = await viewer.hair('axial');
  const again = await middleOf(line(viewer, 'coronal', 'axial'));
  await dragTo(viewer, [again, [again[0], again[1] - 50]]);
  await expect.poll(() => viewer.hair('axial')).not.toEqual(now);
  await viewer.press('Escape');
  await expect.poll(() => viewer.hair('axial')).toEqual(now);
  await viewer.page.mouse.up();
  await dragTo(viewer, await turnedEnd(viewer, end(viewer, 'axial', 'coronal'), 'coronal', 0.5));
  await expect(title(viewer, 'axial')).toHaveText('Axial, oblique');
  await viewer.press('Escape');
  await expect(title(viewer, 'axial')).toHaveText('Axial');
  await viewer.page.mouse.up();
  await viewer.pane('axial').focus();
  await viewer.press('Escape');
  await expect(line(viewer, 'coronal', 'axial')).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});

test('keys turn the planes by 5 degrees, and a button makes them standard again', async ({ browser }) => {
  const viewer = await opened(browser);
  await viewer.press('x');
  await viewer.pane('axial').focus();
  await viewer.press('ArrowRight', 'ArrowRight');
  expect(turnOf(await slices(viewer))).toBeCloseTo(2 * STEP, 9);
  await viewer.pane('sagittal').focus();
  await viewer.press('Shift+ArrowLeft');
  await expect(title(viewer, 'axial')).toHaveText('Axial, oblique');
  await viewer.pane('axial').getByRole('button', { name: 'Reset planes' }).focus();
  await viewer.press('Enter');
  await expect(title(viewer, 'axial')).toHaveText('Axial');
  expect(await slices(viewer)).toBeUndefined();
  await viewer.press('Control+z', 'Control+z', 'Control+z');
  expect(turnOf(await slices(viewer))).toBeCloseTo(STEP, 9);
  viewer.expectNoFault();
  await viewer.close();
});

test('a slab shows its largest, mean or smallest values, and a session keeps planes and slab', async ({
  browser,
}) => {
  const viewer = await opened(browser);
  await toggle(viewer).click();
  await viewer.pane('axial').focus();
  const brightness = async () => {
    const { bytes } = await viewer.pixels('coronal');
    return bytes.reduce((sum, value, n) => sum + (n % 4 === 0 ? value : 0), 0) / (bytes.length / 4);
  };
  const standard = await brightness();
  await viewer.press('ArrowRight');
  // The standard plane is as bright as the slab, so the turned one must be there.
  await expect.poll(brightness).toBeLessThan(standard);
  const thin = await brightness();
  const slab = viewer.pane('coronal').getByLabel('Slab');
  await slab.fill('20');
  await slab.press('Enter');
  await expect(title(viewer, 'coronal')).toHaveText('Coronal, oblique, MIP 20 mm');
  await expect.poll(brightness).toBeGreaterThan(thin);
  const largest = await brightness();
  const values = viewer.pane('coronal').getByLabel('Values of the slab');
  await values.selectOption('min');
  await expect.poll(brightness).toBeLessThan(thin);
  await values.selectOption('mean');
  await expect(title(viewer, 'coronal')).toHaveText('Coronal, oblique, mean 20 mm');
  await expect.poll(brightness).toBeLessThan(largest);
  await viewer.rest();
  await viewer.screenshot('oblique-slab');
  const planes = await slices(viewer);
  expect(planes?.slab).toEqual([20, 'mean']);
  const session = await saved(viewer, SESSION);
  const content = JSON.parse(session.toString('utf-8')).LumencutSession;
  expect([content.format, content.view.slices]).toEqual([2, planes]);
  await viewer.press('r');
  await expect(title(viewer, 'coronal')).toHaveText('Coronal');
  await choose(viewer, fileOf('saved.mrk.json', session));
  await expect(title(viewer, 'coronal')).toHaveText('Coronal, oblique, mean 20 mm');
  await expect(title(viewer, 'axial')).toHaveText('Axial, mean 20 mm');
  const damaged = session.toString('utf-8').replace('"slab":[20', '"slab":[-20');
  await choose(viewer, fileOf('damaged.mrk.json', Buffer.from(damaged)));
  await expect(viewer.problem).toContainText('slab');
  viewer.expectNoFault();
  await viewer.close();
});

test('a finger turns and moves the planes', async ({ browser }) => {
  const viewer = await opened(browser, { hasTouch: true });
  await toggle(viewer).tap();
  const client = await viewer.page.context().newCDPSession(viewer.page);
  const swipe = async ([from, to]: readonly [Pair, Pair]) => {
    const at = ([x, y]: Pair) => ({ touchPoints: [{ x, y }] });
    await client.send('Input.dispatchTouchEvent', { type: 'touchStart', ...at(from) });
    for (const share of [0.1, 0.4, 0.7, 1]) {
      const place = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])] as const;
      await client.send('Input.dispatchTouchEvent', { type: 'touchMove', ...at(place) });
    }
    await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  };
  await swipe(await turnedEnd(viewer, end(viewer, 'coronal', 'axial'), 'axial', 0.5));
  await expect(title(viewer, 'coronal')).toHaveText('Coronal, oblique');
  const before = await viewer.hair('coronal');
  const from = await middleOf(line(viewer, 'axial', 'coronal'));
  await swipe([from, [from[0], from[1] + 40]]);
  await expect.poll(async () => (await viewer.hair('coronal'))[1]).toBeGreaterThan(before[1] + 20);
  viewer.expectNoFault();
  await viewer.close();
});
