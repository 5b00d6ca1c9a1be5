/** Dark lumens are traced by a switch of the tracing tools; context, window and words follow, and a session keeps it. */
import { expect, test } from '@playwright/test';
import { button, choose, fileOf, nameOf, SESSION, saved } from './controls';
import { Viewer } from './page';
import { brightness, NARROWED, openScan, STRAIGHT, tubes } from './scans';

const SIZE = { width: 1200, height: 760 };

/** Lumen of 350 HU becomes air, fat becomes soft tissue. */
const SCAN = tubes(
  'airways.nrrd',
  0,
  () => null,
  (value) => 40 - ((value + 100) * 1040) / 450,
);

const dark = (viewer: Viewer) => viewer.page.getByLabel('Dark lumens (airways)').first();

test('a switch traces airways, in their words, and a session keeps it', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  await openScan(viewer, SCAN);
  await expect(button(viewer, 'Find all vessels').first()).toBeVisible();
  await dark(viewer).check();
  await button(viewer, 'Find all airways').first().click();
  await expect(nameOf(viewer, 1)).toHaveValue('Airway 2');
  await viewer.screenshot('dark-found');
  const session = await saved(viewer, SESSION);
  const content = JSON.parse(session.toString('utf-8')).LumencutSession;
  expect([content.format, content.dark, content.view.settings.context]).toEqual([2, true, 'minip']);
  await button(viewer, 'Trace').first().click();
  await expect(dark(viewer)).toBeChecked();
  // The smallest values of the rays show both lumens; the picked one is in the middle.
  await expect.poll(() => brightness(viewer, 0)).toBeLessThan(100);
  expect(await brightness(viewer, STRAIGHT - NARROWED)).toBeLessThan(100);
  expect(await brightness(viewer, STRAIGHT)).toBeGreaterThan(200);
  await viewer.screenshot('dark-tracing');
  await dark(viewer).uncheck();
  await expect(nameOf(viewer, 1)).toHaveValue('Airway 2');
  await viewer.page.reload();
  await openScan(viewer, SCAN);
  await choose(viewer, fileOf('saved.mrk.json', session));
  await button(viewer, 'Trace').first().click();
  await expect(dark(viewer)).toBeChecked();
  await expect(nameOf(viewer, 1)).toHaveValue('Airway 2');
  viewer.expectNoFault();
  await viewer.close();
});
