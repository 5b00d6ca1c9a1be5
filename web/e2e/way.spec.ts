/** The whole workflow: open a scan, click along a vessel, measure it, save the report. */
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from '@playwright/test';
import {
  button,
  countInput,
  expectBegun,
  menu,
  REPORT,
  rows,
  startTracing,
  stenosis,
  tabTo,
  traced,
} from './controls';
import { Viewer } from './page';
import { pixelAt } from './scans';

const SCAN = join(import.meta.dirname, '../../../shared/data/stent-cta/stent_cta.nii.gz');
/** Extent of the scan (mm), and where its stent and its left limb begin, measured from the centre (mm). */
const EXTENT = [128, 128, 256] as const;
const STENT = [9, 64] as const;
const LIMB = [8.4, -71.7] as const;
const SIZE = { width: 1400, height: 860 };
const MOST_CLICKS = 12;
const GRADED = /\d+ % of the diameter.*NASCET.*\d+\.\d\d? mm/;

test('by mouse, from a scan file to the report', async ({ browser }) => {
  test.skip(!existsSync(SCAN), 'there are no real scans beside the repository');
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  const { page } = viewer;
  const counted = await countInput(viewer);
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    button(viewer, 'Choose files').click(),
  ]);
  await chooser.setFiles(SCAN);
  await viewer.rest();
  await viewer.screenshot('way-1-open');
  await startTracing(viewer);
  await viewer.screenshot('way-2-trace');
  await viewer.click(await pixelAt(viewer, STENT, 'coronal', EXTENT), 'coronal');
  await expectBegun(viewer);
  await viewer.click(await pixelAt(viewer, LIMB, 'coronal', EXTENT), 'coronal');
  await traced(viewer, 1);
  await viewer.rest();
  await viewer.screenshot('way-3-traced');
  await button(viewer, 'Done').click();
  await button(viewer, 'Measure').click();
  // Within a stent no place is suggested; the page says so, and the user marks one.
  await expect(page.getByTestId('not-suggested')).toContainText('sections that count has a doubt (metal');
  await page.getByRole('button', { name: 'Narrowest here' }).click();
  await expect(stenosis(viewer)).toHaveText(
    /^[\d.]+ ± [\d.]+ mm at [\d.]+ mm\. No percentage: mark a reference where the vessel is normal\./,
  );
  await viewer.rest();
  await viewer.screenshot('way-4-measured');
  await menu(viewer).click();
  const [download] = await Promise.all([page.waitForEvent('download'), button(viewer, REPORT).click()]);
  expect(download.suggestedFilename()).toMatch(/^lumencut-report-[\d-]+\.html$/);
  const { clicks, keys } = await counted();
  expect(keys).toBe(0);
  expect(clicks).toBeLessThanOrEqual(MOST_CLICKS);
  const words = (await stenosis(viewer).textContent()) ?? '';
  const html = readFileSync(await download.path(), 'utf-8');
  expect(html).toContain(words);
  expect(html).not.toContain('stent_cta');
  viewer.expectNoFault();
  const report = await browser.newPage({ viewport: { width: 900, height: 1200 } });
  await report.setContent(html);
  await report.screenshot({ path: 'test-results/screens/way-5-report.png', fullPage: true });
  await report.close();
  await viewer.close();
});

test('by keys only, from the start page to the report', { tag: '@long' }, async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  const { page } = viewer;
  const counted = await countInput(viewer);
  await expect(button(viewer, 'A tube with a stenosis of 50 %')).toBeEnabled();
  await tabTo(viewer, 'A tube with a stenosis');
  await viewer.press('Enter');
  await viewer.rest();
  await viewer.press('v');
  await tabTo(viewer, /^Delete$/);
  await viewer.press('Enter');
  await expect(rows(viewer)).toHaveCount(0);
  await viewer.press('t');
  await expect(viewer.pane('coronal')).toBeVisible();
  await tabTo(viewer, 'coronal slice');
  for (let n = 0; n < 5; n++) {
    await viewer.press('Shift+ArrowUp');
  }
  await viewer.press('Enter');
  await expectBegun(viewer);
  for (let n = 0; n < 10; n++) {
    await viewer.press('Shift+ArrowDown');
  }
  await viewer.press('Enter');
  await traced(viewer, 1);
  await viewer.press('Enter');
  await expect(button(viewer, 'End this vessel')).toHaveCount(0);
  await viewer.screenshot('keys-traced');
  await viewer.press('Escape', 'm');
  await expect(button(viewer, 'Confirm the suggested places')).toBeVisible();
  await tabTo(viewer, /^Confirm the suggested places$/);
  await viewer.press('Enter');
  await expect(stenosis(viewer)).toHaveText(GRADED);
  await viewer.screenshot('keys-measured');
  await tabTo(viewer, /^Save$/);
  await viewer.press('Enter');
  await tabTo(viewer, REPORT.replace(/[()]/g, '.'));
  const [download] = await Promise.all([page.waitForEvent('download'), viewer.press('Enter')]);
  expect(readFileSync(await download.path(), 'utf-8')).toContain(
    (await stenosis(viewer).textContent()) ?? '',
  );
  expect((await counted()).clicks).toBe(0);
  viewer.expectNoFault();
  await viewer.close();
});
