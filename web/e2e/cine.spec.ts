/** The straightened vessel rolls and the section moves by themselves; windows that the user named are kept in the browser. */
import { expect, type Locator, test } from '@playwright/test';
import { button } from './controls';
import { Viewer } from './page';

let viewer: Viewer;
test.beforeAll(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu', {
    viewport: { width: 1600, height: 800 },
    hasTouch: true,
  });
  await viewer.rest();
});
test.afterEach(() => viewer.expectNoFault());
test.afterAll(() => viewer.close());

const play = (kind: string): Locator => button(viewer, `Play ${kind}`);
const roll = async () =>
  Number(await viewer.page.getByLabel('Rotation about the vessel (degrees)').inputValue());
const at = async () => Number(/([\d.]+) mm$/.exec((await viewer.readOut.textContent()) ?? '')?.[1]);

/** Whether a number stays the same for several frames. */
async function isStill(number: () => Promise<number>): Promise<boolean> {
  await viewer.rest();
  const before = await number();
  await viewer.frames();
  return (await number()) === before;
}

test('the roll plays and pauses by mouse, and Escape stops it', async () => {
  const before = await roll();
  await play('roll').click();
  await expect.poll(roll).not.toBe(before);
  await play('roll').click();
  expect(await isStill(roll)).toBe(true);
  await play('roll').press('Enter');
  await expect(play('roll')).toHaveAttribute('aria-pressed', 'true');
  await viewer.press('Escape');
  await expect(play('roll')).toHaveAttribute('aria-pressed', 'false');
});

test('sections play along the vessel by a tap, and only one cine plays', async () => {
  const before = await at();
  await play('sections').tap();
  await expect.poll(at).not.toBe(before);
  await play('roll').tap();
  await expect(play('sections')).toHaveAttribute('aria-pressed', 'false');
  await play('roll').tap();
  expect(await isStill(at)).toBe(true);
});

test('a window is kept under a name, chosen again after a reload, undone and deleted', async () => {
  const { page } = viewer;
  const presets = () => page.getByLabel('Window preset');
  const name = () => page.getByLabel('Name of this window');
  await page.getByRole('slider', { name: 'Level of the window' }).focus();
  await viewer.press('Shift+ArrowRight');
  const own = (await viewer.state()).window;
  await viewer.press('9');
  await expect(presets().locator('option:checked')).toHaveText('Aneurysm sac (9)');
  expect((await viewer.state()).window).toEqual([150, 600]);
  await viewer.press('Control+z');
  await presets().selectOption('Keep this window …');
  await viewer.press('Escape');
  await presets().selectOption('Keep this window …');
  await name().fill('Sac and stent');
  await viewer.press('Enter');
  await expect(presets().locator('option:checked')).toHaveText('Sac and stent');
  await viewer.screenshot('own-window');
  await page.reload();
  await viewer.rest();
  await presets().selectOption({ index: 2 });
  await presets().selectOption('Sac and stent');
  expect((await viewer.state()).window).toEqual(own);
  await viewer.press('Control+z');
  expect((await viewer.state()).window).not.toEqual(own);
  await viewer.press('Control+Shift+Z');
  await presets().selectOption('Delete Sac and stent');
  await expect(presets().locator('option', { hasText: 'Sac and stent' })).toHaveCount(0);
  await page.evaluate(() =>
    localStorage.setItem('lumencut.windows', '[{"name": 7}, null, {"name": "x", "window": [1]}]'),
  );
  await page.reload();
  await viewer.rest();
  await expect(presets().locator('option')).not.toContainText(['x']);
});
