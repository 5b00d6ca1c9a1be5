/** Tests of the best view of a vessel, and of turning about a place on it, by mouse and keys. */
import { expect, type Locator, test } from '@playwright/test';
import { dot } from '../src/core/vectors';
import { button, fileOf, type MadeFile } from './controls';
import { nrrd } from './nrrd';
import { Viewer } from './page';

const SIZE = { width: 1280, height: 800 };
/** Numbers of voxels along the axes, and voxel size (mm). */
const COUNTS = [60, 60, 90] as const;
const SIDE = 0.6;
/** Position of the tube (mm to the patient's left). If the scan were mirrored, the tube would lie outside. */
const LEFT = 100;
/** Semi-axes of the lumen (mm), right to left and front to back. */
const AXES = [6, 3.5] as const;

/** A scan of a tube with an elliptical lumen; on every ray the value at the wall is half way. */
const tube = (): MadeFile =>
  nrrd('tube.nrrd', { counts: COUNTS, side: SIDE, middle: [LEFT, 0, 0] }, (x, y) => {
    const away = Math.hypot(x, y);
    const inside = away / Math.hypot(x / AXES[0], y / AXES[1]) - away;
    return -50 + 400 * Math.min(Math.max(0.5 + inside / (2 * SIDE), 0), 1);
  });

function centerline(): MadeFile {
  const radius = Math.sqrt(AXES[0] * AXES[1]);
  const rows = Array.from({ length: 41 }, (_, n) => `${LEFT},0,${n - 20},${radius}`);
  return fileOf('tube.csv', Buffer.from(`x,y,z,radius\n${rows.join('\n')}\n`));
}

let viewer: Viewer;
test.beforeAll(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  await expect(button(viewer, 'Choose files')).toBeEnabled();
  await viewer.page.locator('main input[type=file]').first().setInputFiles([tube(), centerline()]);
  await viewer.rest();
});
test.afterEach(() => viewer.expectNoFault());
test.afterAll(() => viewer.close());

const bar = (): Locator => viewer.page.getByTestId('place-turn');
const angle = (): Locator => bar().getByRole('slider');

async function diameters(): Promise<number[]> {
  const words = (await bar().getByRole('status').textContent()) ?? '';
  return [...words.matchAll(/([\d.]+) mm/g)].map(([, number]) => Number(number));
}

/** Expects the diameters of the ellipse, up to errors from rounding and voxel size. */
function expectDiameters(found: readonly number[], expected: readonly number[]): void {
  expect(found).toHaveLength(expected.length);
  found.forEach((diameter, n) => {
    expect(Math.abs(diameter - (expected[n] ?? 0))).toBeLessThanOrEqual(0.15);
  });
}

test('by keys: turning about a place shows its diameters, and the place keeps its pixel', {
  tag: '@long',
}, async () => {
  await viewer.press('o');
  await expect(angle()).toBeFocused();
  const first = await viewer.camera();
  const place = await viewer.hair('turning');
  expectDiameters(await diameters(), [12, 12, 12]);
  await viewer.press(...Array<string>(90).fill('ArrowRight'));
  expectDiameters(await diameters(), [7, 7, 12]);
  const side = await viewer.camera();
  expect(dot(side.direction, first.direction)).toBeCloseTo(0, 9);
  expect(await viewer.hair('turning')).toEqual(place);
  await viewer.screenshot('turn-about-a-place');
  await viewer.press('Escape');
  await expect(bar()).toHaveCount(0);
  await expect(viewer.pane()).toBeFocused();
  expect(await viewer.camera()).toEqual(side);
});

test('by mouse: a drag turns about the place of the section, and Escape undoes it', async () => {
  await viewer.press('m');
  const begin = viewer.page.getByTestId('numbers').getByRole('button', { name: /^Turn about/ });
  await begin.click();
  await expect(bar()).toBeVisible();
  const first = await viewer.camera();
  const [, height] = await viewer.size();
  await viewer.drag([0.3, 0.8], [-height / 4, 30], { isHeld: true });
  await expect(bar().locator('.place-turn-degrees')).toHaveText('45°');
  await viewer.press('Escape');
  await viewer.page.mouse.up();
  await expect(bar().locator('.place-turn-degrees')).toHaveText('0°');
  expect(await viewer.camera()).toEqual(first);
  await viewer.drag([0.3, 0.8], [height / 2, 0]);
  await expect(bar().locator('.place-turn-degrees')).toHaveText('-90°');
  expectDiameters(await diameters(), [7, 7, 12]);
  // Zooming does not end turning about the place; another view does.
  await viewer.wheel([0.5, 0.6], -240);
  expect((await viewer.camera()).pixel_spacing).toBeLessThan(0.9 * first.pixel_spacing);
  await expect(begin).toHaveAttribute('aria-pressed', 'true');
  await viewer.press('Shift+S');
  await expect(bar()).toHaveCount(0);
  // Pressing the button again ends turning without moving the cross-hair.
  await begin.click();
  await expect(bar()).toBeVisible();
  const place = await viewer.readOut.textContent();
  await bar().getByRole('button', { name: 'Done' }).click();
  await expect(bar()).toHaveCount(0);
  await expect(viewer.readOut).toHaveText(place ?? '');
  await viewer.press('m');
});

test('the best view shows a vessel from the side, by a button in its row and by a key', async () => {
  for (const ask of [
    async () => {
      await viewer.press('v');
      await button(viewer, 'Best view').click();
    },
    () => viewer.press('f'),
  ]) {
    await viewer.look('Shift+S', 'L', 'A');
    await ask();
    await expect(viewer.pane().locator('.edge.top')).toContainText('S');
    const best = await viewer.camera();
    expect(Math.abs(best.direction[2])).toBeLessThan(0.2);
    expect(dot(best.up, [0, 0, 1])).toBeGreaterThan(0.95);
  }
  await viewer.press('v');
});
