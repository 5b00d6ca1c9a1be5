/** All vessels of a scan are found from the page's offer, as one step. */
import { expect, test } from '@playwright/test';
import { button, rows, untraced } from './controls';

test('a page without vessels offers to find all of them, in one step that can be undone', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  await button(viewer, 'Find all vessels').last().click();
  await expect.poll(() => rows(viewer).count(), { timeout: 50_000 }).toBeGreaterThan(1);
  const count = await rows(viewer).count();
  await expect(button(viewer, 'Find all vessels')).toHaveCount(1);
  await viewer.screenshot('find-vessels');
  // What is told of them goes away by Escape and by a press elsewhere, and the vessels stay.
  const notes = viewer.page.locator('footer summary');
  const note = viewer.page.locator('footer .menu-body li').first();
  for (const close of [() => viewer.press('Escape'), () => viewer.click([0.5, 0.1])]) {
    await notes.click();
    await expect(note).toBeVisible();
    await close();
    await expect(note).toBeHidden();
  }
  await expect(rows(viewer)).toHaveCount(count);
  await viewer.press('Control+z');
  await expect(rows(viewer)).toHaveCount(0);
  await viewer.press('Control+y');
  await expect(rows(viewer)).toHaveCount(count);
  viewer.expectNoFault();
  await viewer.close();
});

test('finding tells how far it is, and Escape stops it', async ({ browser }) => {
  test.setTimeout(120_000);
  const viewer = await untraced(browser, 'aorta');
  await button(viewer, 'Find all vessels').last().click();
  await expect(viewer.page.getByRole('progressbar')).toBeVisible();
  await expect(viewer.page.getByText('Finding vessels')).toBeVisible();
  await viewer.press('Escape');
  await expect(viewer.page.getByRole('progressbar')).toHaveCount(0);
  await expect(rows(viewer)).toHaveCount(0);
  await expect(button(viewer, 'Find all vessels').last()).toBeEnabled();
  viewer.expectNoFault();
  await viewer.close();
});
