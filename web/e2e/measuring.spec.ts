/** Measuring in the page beside all else that it does. */
import { expect, test } from '@playwright/test';
import { Viewer } from './page';

test('a vessel is measured while the view is turned', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu&test');
  await viewer.rest();
  const lines = ((await viewer.report()).vessels ?? []).map(({ line }) => line);
  const told = viewer.measuring(async (measuring, all) => {
    const words: (number | null)[] = [];
    for (const line of all) {
      await measuring.profile(line, 0.7, ({ total }) => words.push(total));
    }
    return words;
  }, lines);
  for (let n = 0; n < 4; n++) {
    await viewer.drag([0.4, 0.5], [30, 10]);
  }
  expect(await told).toEqual(lines.flatMap(() => [null, 1]));
  await viewer.rest();
  viewer.expectNoFault();
  await viewer.close();
});

test('a line that is not shown is refused', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu&test');
  await viewer.rest();
  const words = await viewer.measuring(
    (measuring, line) => measuring.diameterAt(line, 0).then(String, String),
    1e6,
  );
  expect(words).toContain('number of the line: found 1000000; expected one of the lines that are shown');
  await viewer.close();
});
