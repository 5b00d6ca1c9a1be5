/** The first step of the tour by a user who acts before the engine has answered; and keys that move the keyboard focus. */
import { type Browser, expect, type Page, test } from '@playwright/test';
import { Viewer } from './page';

const SIZE = { width: 1100, height: 720 };
/** Heights of two points on the tube, as shares of the height of the coronal pane. */
const [UPPER, LOWER] = [0.3, 0.7];

async function guided(browser: Browser): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  await viewer.page.getByRole('button', { name: 'Two-minute guided tour' }).click();
  await expect(viewer.pane()).toBeVisible();
  return viewer;
}

const guide = (page: Page) => page.getByLabel('Guided tour');

test('points that are set quickly become a vessel, even if Done is pressed at once', async ({ browser }) => {
  const viewer = await guided(browser);
  const { page } = viewer;
  await expect(guide(page)).toContainText('Press “Trace” or');
  await expect(guide(page)).not.toContainText('coronal');
  const height = (await guide(page).boundingBox())?.height;
  await viewer.press('t');
  await expect(guide(page)).toContainText('In the coronal slice');
  await expect(viewer.pane('coronal')).toBeFocused();
  await viewer.rest();
  await viewer.screenshot('guide-trace');
  const [width, paneHeight] = await viewer.size('coronal');
  const at = (down: number) => viewer.place([width / 2, down * paneHeight], 'coronal');
  const [first, second] = [await at(UPPER), await at(LOWER)];
  await page.mouse.click(...first);
  await page.mouse.click(...second);
  await page.getByRole('button', { name: 'Done', exact: true }).click();
  await expect(guide(page)).toContainText('2 of 5');
  expect((await guide(page).boundingBox())?.height).toBe(height);
  await expect(page.locator('.vessel-rows input.name')).toHaveValue('Vessel 1');
  await viewer.press('m');
  await expect(page.locator('[data-testid="numbers"] button').first()).toBeFocused();
  for (const [keys, file] of [
    ['Control+s', /-session-[\d-]+\.mrk\.json$/],
    ['Control+Shift+S', /^lumencut-report-[\d-]+\.html$/],
  ] as const) {
    const [download] = await Promise.all([page.waitForEvent('download'), viewer.press(keys)]);
    expect(download.suggestedFilename()).toMatch(file);
  }
  await viewer.press('?');
  const help = page.getByRole('dialog', { name: 'Keys and mouse' });
  await expect(help.getByRole('button', { name: 'Close' }).first()).toBeFocused();
  await viewer.screenshot('guide-help');
  viewer.expectNoFault();
  await viewer.close();
});

test('a first click outside the scan is rejected at once', async ({ browser }) => {
  const viewer = await guided(browser);
  await viewer.press('t');
  await expect(viewer.pane('coronal')).toBeVisible();
  await viewer.rest();
  await viewer.click([3, 120], 'coronal');
  await expect(viewer.problem).toContainText('outside the volume; expected a point between its corners');
  await expect(viewer.page.locator('[data-place=first]')).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});
