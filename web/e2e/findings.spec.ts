/** Report mode: sentence and key image of each finding, to copy and to save. */
import { readFileSync } from 'node:fs';
import { type Browser, expect, type Locator, test } from '@playwright/test';
import { button, rows, tabTo } from './controls';
import { Viewer } from './page';
import { openBentTube } from './streams';

const SIZE = { width: 1280, height: 800 };

async function twoVessels(browser: Browser): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?device=cpu', {
    viewport: SIZE,
    permissions: ['clipboard-read', 'clipboard-write'],
  });
  await openBentTube(viewer.page, 55);
  await viewer.rest();
  await viewer.press('v');
  return viewer;
}

const panel = (viewer: Viewer): Locator => viewer.page.getByTestId('findings');
const findings = (viewer: Viewer): Locator => panel(viewer).locator('section[aria-label^="Finding on"]');
const mode = (viewer: Viewer, words: string): Locator =>
  viewer.page.locator('.modes').getByRole('button', { name: words });

async function mark(viewer: Viewer, vessel: number): Promise<void> {
  await rows(viewer).nth(vessel).getByRole('radio').check();
  await mode(viewer, 'Measure').dblclick();
  await expect(viewer.page.getByTestId('row-place-0')).toBeVisible();
  await button(viewer, 'Narrowest here').click();
  await expect(viewer.page.getByTestId('row-place-0')).toContainText('marked place');
  await mode(viewer, 'Look').click();
}

test('findings of all vessels are listed by a key, copied, and saved as one report, also by keys', async ({
  browser,
}) => {
  const viewer = await twoVessels(browser);
  const before = await viewer.camera();
  await mode(viewer, 'Report').click();
  await expect(panel(viewer)).toContainText('Findings appear here once');
  await mode(viewer, 'Look').click();
  await mark(viewer, 0);
  await mark(viewer, 1);
  await viewer.pane().focus();
  await viewer.press('e');
  await expect(mode(viewer, 'Report')).toHaveAttribute('aria-pressed', 'true');
  await expect(findings(viewer)).toHaveCount(2);
  expect((await viewer.camera()).direction).toEqual(before.direction);
  const [first, second] = [findings(viewer).nth(0), findings(viewer).nth(1)];
  await expect(first).toContainText('No percentage: mark a reference where the vessel is normal.');
  for (const one of [first, second]) {
    const picture = one.getByRole('img');
    await expect(picture).toBeVisible();
    expect(await picture.evaluate((image) => (image as HTMLImageElement).naturalWidth)).toBe(900);
  }
  await viewer.screenshot('report-mode');

  await first.getByRole('button', { name: 'Copy sentence' }).click();
  await expect(viewer.page.getByTestId('told')).toHaveText('The sentence is copied');
  const copied = await viewer.page.evaluate(() => navigator.clipboard.readText());
  expect(copied).toMatch(/: .* mm at .* mm\. No percentage: mark a reference/);
  await second.getByRole('button', { name: 'Copy picture' }).click();
  await expect(viewer.page.getByTestId('told')).toHaveText('The picture is copied');
  const types = await viewer.page.evaluate(async () => (await navigator.clipboard.read())[0]?.types);
  expect(types).toEqual(['image/png']);

  const pages = async (save: () => Promise<void>) => {
    const [download] = await Promise.all([viewer.page.waitForEvent('download'), save()]);
    expect(download.suggestedFilename()).toMatch(/-report-.*\.html$/);
    return readFileSync(await download.path(), 'utf-8').match(/<h1>/g)?.length;
  };
  await viewer.pane().focus();
  await tabTo(viewer, /^Save report$/);
  expect(await pages(() => viewer.press('Enter'))).toBe(2);
  await first.getByLabel('in the report').uncheck();
  expect(await pages(() => button(viewer, 'Save report').click())).toBe(1);

  await first.getByRole('button', { name: 'Show' }).click();
  await expect(rows(viewer).nth(0).getByRole('radio')).toBeChecked();
  await viewer.press('Control+z');
  await expect(findings(viewer)).toHaveCount(1);
  await viewer.press('Control+y');
  await expect(findings(viewer)).toHaveCount(2);

  // A hidden vessel has no pictures, so only its name is listed.
  await rows(viewer).nth(0).locator('.eye').click();
  await expect(findings(viewer)).toHaveCount(1);
  await expect(panel(viewer)).toContainText('Not in the report, because hidden:');
  await viewer.press('e');
  await expect(mode(viewer, 'Look')).toHaveAttribute('aria-pressed', 'true');
  viewer.expectNoFault();
  await viewer.close();
});
