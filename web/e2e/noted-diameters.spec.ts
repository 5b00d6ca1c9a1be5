/** A noted diameter or a reference can be the only mark, and the buttons at the section stay inside the pane. */
import { expect, test } from '@playwright/test';
import { REPORT, SESSION } from './controls';
import { MeasuredTube } from './measured-tube';

let tube: MeasuredTube;
test.beforeAll(async ({ browser }) => {
  tube = await MeasuredTube.open(browser);
});
test.afterEach(() => tube.viewer.expectNoFault());

test('a diameter noted at the section appears in the table, all views, report and session', async () => {
  await tube.button('Diameter here').click();
  const row = tube.row('diameter-0');
  await expect(row).toContainText('noted diameter');
  const at = (await tube.arcLength('diameter-0')).toFixed(1);
  for (const where of ['in the profile', 'in the CPR', 'on the vessel']) {
    await expect(tube.handle(`noted diameter, ${at} mm`, where)).toBeVisible();
  }
  const report = await tube.saved(REPORT);
  expect(report).toMatch(new RegExp(`Diameter: [\\d.]+ ± [\\d.]+ mm at ${at} mm, [\\d.]+ to [\\d.]+ mm`));
  expect(report).toContain('noted diameter</td>');
  expect(report).not.toContain('No percentage');
  const session = JSON.parse(await tube.saved(SESSION)).LumencutSession;
  expect([session.format, session.vessels[0].marks.diameters_mm]).toEqual([2, [Number(at)]]);
  await row.getByRole('button', { name: 'Remove the noted diameter' }).click();
  await expect(row).toHaveCount(0);
});

test('a single reference is drawn, and no error is shown', async () => {
  await tube.nothingMarked();
  await tube.button('Reference here').click();
  await expect(tube.viewer.page.getByTestId('stenosis').locator('.refused')).toHaveCount(0);
  await expect(tube.stenosis()).toContainText('Narrowest here');
  await tube.nothingMarked();
});

test('at the end of the vessel, buttons and read-out stay within the pane', async () => {
  const { page } = tube.viewer;
  const chart = await page.getByTestId('chart').boundingBox();
  if (!chart) {
    throw new Error('no chart');
  }
  const [x, y] = await tube.middleOf(tube.tick('60'));
  await page.mouse.click(x, y - 40);
  await expect(page.getByTestId('chart-reading')).toContainText('60.0 mm');
  for (const part of [page.locator('.section-tools'), page.getByTestId('chart-reading')]) {
    const box = await part.boundingBox();
    expect(box?.x).toBeGreaterThanOrEqual(chart.x);
    expect((box?.x ?? 0) + (box?.width ?? 0)).toBeLessThanOrEqual(chart.x + chart.width);
  }
});
