/** The engine measures while the page does other work. */
import { expect, test } from '@playwright/test';
import { Viewer } from './page';

test('a vessel is measured while the view is turned; a line that is not displayed is rejected', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu&test');
  await viewer.rest();
  const line = (await viewer.report()).vessels?.[0]?.line ?? -1;
  const measured = viewer.ask('profile', { line, fwhm: 0.7 });
  for (let n = 0; n < 4; n++) {
    await viewer.drag([0.4, 0.5], [30, 10]);
  }
  expect((await measured).fwhm_source).toBe('given');
  await viewer.rest();
  viewer.expectNoFault();
  const words = await viewer.ask('diameter_at', { line: 1e6, at: 0 }).then(String, String);
  expect(words).toContain('number of the line: found 1000000; expected one of the lines that are shown');
  await viewer.close();
});
