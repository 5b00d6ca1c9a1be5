/** A rim shows values along the vessels with a legend; a network map leads to the places of its lines. */
import { expect, test } from '@playwright/test';
import { difference, SAME_CODE } from './compare';
import { Viewer, viewFragment } from './page';

test('a rim appears with its legend, and a value without measurements states what it needs', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu');
  await viewer.rest();
  const before = await viewer.pixels('turning');
  // The ends of its range are fields too.
  const choose = (value: string) =>
    viewer.research(() => viewer.field('rim').and(viewer.page.locator('select')).selectOption(value));
  await choose('diameter');
  await expect(viewer.page.getByTestId('rim-legend')).toContainText(/diameter.*mm.*mm/);
  await expect.poll(async () => difference(await viewer.pixels('turning'), before, SAME_CODE)).not.toBeNull();
  await viewer.screenshot('rim-diameter');
  await choose('narrowing');
  await expect(viewer.page.locator('p.rim-legend')).toContainText('no graded stenosis');
  await expect.poll(async () => difference(await viewer.pixels('turning'), before, SAME_CODE)).toBeNull();
  viewer.expectNoFault();
  await viewer.close();
});

test('a click in the network map puts the cross-hair on the vessel', async ({ browser }) => {
  const fragment = viewFragment({ layout: 'two', vessel: 0 });
  const viewer = await Viewer.open(browser, `?phantom=y_junction&device=cpu${fragment}`);
  await viewer.rest();
  await viewer.page.getByLabel('Reformation', { exact: true }).selectOption('network');
  await expect(viewer.page.locator('.reformed .axes')).toContainText('Colours: diameter from');
  await viewer.screenshot('network-map');
  await viewer.click([0.5, 0.5], 'straightened');
  await expect(viewer.readOut).toHaveText(/ · \d+\.\d mm$/);
  viewer.expectNoFault();
  await viewer.close();
});
