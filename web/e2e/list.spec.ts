/** Tests of vessel names, of keeping vessels over a reload, of saving centerlines, and of region presets. */
import { expect, test } from '@playwright/test';
import { button, nameOf, rename, rows, SIZE } from './controls';
import { Viewer } from './page';

const YJUNCTION = '?phantom=y_junction&device=cpu';

async function opened(browser: Parameters<typeof Viewer.open>[0]): Promise<Viewer> {
  const viewer = await Viewer.open(browser, YJUNCTION, { viewport: SIZE });
  await expect(viewer.pane()).toBeVisible();
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(3);
  return viewer;
}

test('a click on a name picks its vessel, a second one or F2 changes it, and vessels that join are a tree', async ({
  browser,
}) => {
  const viewer = await opened(browser);
  await expect(viewer.page.getByLabel(/^As a tree/)).toBeChecked();
  await expect(rows(viewer).nth(2)).toHaveAttribute('data-depth', '1');
  await nameOf(viewer, 2).click();
  await expect(rows(viewer).nth(2).getByRole('radio')).toBeChecked();
  await expect(nameOf(viewer, 2)).toHaveAttribute('readonly');
  // While a name has the focus but is not edited, keys act on the page.
  await viewer.press('m');
  await expect(viewer.page.locator('main.layout')).toHaveAttribute('data-layout', 'measure');
  await viewer.press('m');
  await nameOf(viewer, 2).click();
  await expect(nameOf(viewer, 2)).not.toHaveAttribute('readonly');
  await viewer.page.keyboard.type('SMA');
  await viewer.press('Tab');
  await expect(nameOf(viewer, 2)).toHaveValue('SMA');
  await rename(viewer, 1, 'Celiac trunk');
  await expect(nameOf(viewer, 1)).toHaveValue('Celiac trunk');
  await viewer.screenshot('list-names');
  viewer.expectNoFault();
  await viewer.close();
});

test('the browser asks before an unsaved tree is lost, and a session kept on request is offered again', async ({
  browser,
}) => {
  const viewer = await opened(browser);
  const { page } = viewer;
  const asked: string[] = [];
  page.on('dialog', (dialog) => {
    asked.push(dialog.type());
    void dialog.accept();
  });
  await rows(viewer).nth(1).getByRole('radio').check();
  await button(viewer, 'Delete').click();
  await expect(rows(viewer)).toHaveCount(2);
  const held = () => page.evaluate(() => Object.keys(sessionStorage));
  expect(await held()).toEqual([]);
  await page.locator('summary', { hasText: 'Save' }).click();
  await page.getByLabel('Keep the session when this tab reloads').check();
  await expect.poll(held).toContain('lumencut-session');
  await page.reload();
  expect(asked).toEqual(['beforeunload']);
  await button(viewer, 'Continue with them').click();
  await expect(rows(viewer)).toHaveCount(2);
  viewer.expectNoFault();
  await viewer.close();
});

test('centerlines are saved from the menu "Save", and the message then covers no button', async ({
  browser,
}) => {
  const viewer = await opened(browser);
  const { page } = viewer;
  await page.locator('summary', { hasText: 'Save' }).click();
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    button(viewer, 'Centerlines (.vtp)').click(),
  ]);
  expect(download.suggestedFilename()).toMatch(/-centerlines-[\d-]+\.vtp$/);
  const told = page.getByTestId('told');
  await expect(told).toContainText('.vtp');
  const [box, list] = [await told.boundingBox(), await page.locator('aside.vessels').boundingBox()];
  expect(box?.x ?? 0).toBeGreaterThan((list?.x ?? 0) + (list?.width ?? 0));
  viewer.expectNoFault();
  await viewer.close();
});

test('a region selects look, slab and window; the change of the window is an undo step', async ({
  browser,
}) => {
  const viewer = await opened(browser);
  const region = viewer.page.getByLabel('Look by region');
  const before = await viewer.window.textContent();
  await region.selectOption('runoff');
  await expect(region).toHaveValue('runoff');
  await expect(button(viewer, 'Thick slab')).toHaveAttribute('aria-pressed', 'true');
  await expect(viewer.window).not.toHaveText(before ?? '');
  await viewer.screenshot('look-by-region');
  await viewer.press('Control+z');
  await expect(viewer.window).toHaveText(before ?? '');
  await expect(region).toHaveValue('');
  viewer.expectNoFault();
  await viewer.close();
});
