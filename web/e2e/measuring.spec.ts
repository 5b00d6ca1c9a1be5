/** A vessel can be measured while the page does other work. */
import { expect, test } from '@playwright/test';
import { Viewer } from './page';

test('a vessel is measured while the view is turned', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu&test');
  await viewer.rest();
  const lines = ((await viewer.report()).vessels ?? []).map(({ line }) => line);
  const measured = lines.map((line) => viewer.ask('profile', { line, fwhm: 0.7 }));
  for (let n = 0; n < 4; n++) {
    await viewer.drag([0.4, 0.5], [30, 10]);
  }
  const sources = (await Promise.all(measured)).map(({ fwhm_source: source }) => source);
  expect(sources).toEqual(lines.map(() => 'given'));
  await viewer.rest();
  viewer.expectNoFault();
  await viewer.close();
});

test('measuring a line that is not displayed is rejected', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu&test');
  await viewer.rest();
  const words = await viewer.ask('diameter_at', { line: 1e6, at: 0 }).then(String, String);
  expect(words).toContain('number of the line: found 1000000; expected one of the lines that are shown');
  await viewer.close();
});

test('while a vessel is measured, the section is marked as outdated until the requested one is shown', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=aorta&device=cpu', {
    viewport: { width: 1280, height: 800 },
  });
  await viewer.rest();
  await viewer.press('m');
  const busy = viewer.pane('section').locator('.busy');
  const measuring = viewer.page.getByRole('progressbar', { name: 'Measuring the vessel' });
  await expect(measuring).toBeVisible();
  await viewer.wheel([0.5, 0.5], 120, 'section');
  await expect(busy).toBeVisible({ timeout: 2000 });
  await expect(measuring).toBeVisible();
  await viewer.screenshot('section-busy');
  await expect(measuring).toHaveCount(0, { timeout: 60_000 });
  await expect(busy).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});
