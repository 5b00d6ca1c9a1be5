/** Counts the user actions from a scan to a clean tree and a saved finding. */
import { readFileSync } from 'node:fs';
import { expect, type Locator, test } from '@playwright/test';
import { button, countInput, rows, untraced } from './controls';

const MAX_ACTIONS = 20;

async function slide(slider: Locator, part: number): Promise<void> {
  // The range of the slider is known once the lengths of the vessels are.
  await expect.poll(async () => Number(await slider.getAttribute('max'))).toBeGreaterThan(10);
  const width = (await slider.boundingBox())?.width ?? 0;
  await slider.click({ position: { x: part * width, y: 4 } });
}

test('from a scan without vessels to a clean tree and a saved finding in at most 20 actions', {
  tag: '@long',
}, async ({ browser }) => {
  test.setTimeout(800_000);
  const viewer = await untraced(browser, 'aorta');
  await viewer.press('v');
  await expect(viewer.page.locator('aside.vessels')).toHaveCount(0);
  const counted = await countInput(viewer);

  await button(viewer, 'Find all vessels').last().click();
  await viewer.press('v');
  await expect(viewer.page.locator('.doubtful-rows')).toContainText('left out', { timeout: 300_000 });
  const found = await rows(viewer).count();

  await button(viewer, 'Leave all out').click();
  await expect(viewer.page.locator('.doubtful-rows')).toHaveCount(0);
  await viewer.page.getByText('Clean up', { exact: true }).click();
  await slide(viewer.page.getByRole('slider', { name: 'Shorter than' }), 0.7);
  await expect(viewer.page.locator('.vessel-rows .marked').first()).toBeVisible();
  await viewer.page.getByRole('button', { name: /^Remove \d+ vessels?$/ }).click();
  await expect(viewer.page.locator('.vessel-rows .marked')).toHaveCount(0);
  expect(await rows(viewer).count()).toBeLessThan(found);

  await rows(viewer).nth(1).getByRole('radio').click();
  await viewer.press('m');
  await expect(button(viewer, 'Narrowest here')).toBeVisible({ timeout: 300_000 });
  await button(viewer, 'Narrowest here').click();
  const chart = await viewer.page.getByTestId('chart').boundingBox();
  await viewer.page.mouse.click(
    (chart?.x ?? 0) + 0.8 * (chart?.width ?? 0),
    (chart?.y ?? 0) + 0.7 * (chart?.height ?? 0),
  );
  await button(viewer, 'Reference here').click();
  await expect(viewer.page.getByTestId('row-place-0')).toContainText('marked place');

  await viewer.press('e');
  const finding = viewer.page.getByTestId('findings').locator('section[aria-label^="Finding on"]');
  await expect(finding).toHaveCount(1);
  await expect(finding.getByRole('img')).toBeVisible();
  const [download] = await Promise.all([
    viewer.page.waitForEvent('download'),
    button(viewer, 'Save report').click(),
  ]);
  expect(readFileSync(await download.path(), 'utf-8')).toMatch(/ of the diameter \(NASCET\)|No percentage: /);
  const { clicks, keys } = await counted();
  expect(clicks + keys).toBeGreaterThan(8);
  expect(clicks + keys).toBeLessThanOrEqual(MAX_ACTIONS);
  await viewer.screenshot('count-report');
  viewer.expectNoFault();
  await viewer.close();
});
