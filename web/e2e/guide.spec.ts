/** The guided tour: it advances by itself and can be left at any time. */
import { AxeBuilder } from '@axe-core/playwright';
import { expect, test } from '@playwright/test';
import { button, expectBegun, menu, REPORT, rows, startTracing, stenosis, traced } from './controls';
import { Viewer } from './page';

const START = 'Two-minute guided tour';
let viewer: Viewer;

test.beforeEach(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?device=cpu', { viewport: { width: 1200, height: 760 } });
  await button(viewer, START).click();
  await viewer.rest();
});
test.afterEach(async () => {
  viewer.expectNoFault();
  await viewer.close();
});

const guide = () => viewer.page.getByRole('complementary', { name: 'Guided tour' });
const expectStep = (title: string) => expect(guide().getByRole('heading')).toHaveText(title);

async function serious(): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page: viewer.page })
    .include('[aria-label="Guided tour"]')
    .analyze();
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
}

test('each completed step leads to the next one, up to the report', async () => {
  await expectStep('1 of 5: Trace the vessel');
  await viewer.screenshot('guide-1');
  await startTracing(viewer);
  await viewer.click([0.5, 0.2], 'coronal');
  await expectBegun(viewer);
  await viewer.screenshot('guide-1-clicked');
  await viewer.click([0.5, 0.8], 'coronal');
  await traced(viewer, 1);
  await viewer.press('Enter');
  await expectStep('1 of 5: Trace the vessel');
  await button(viewer, 'Done').click();

  await expectStep('2 of 5: Turn it');
  await viewer.screenshot('guide-2');
  expect(await serious()).toEqual([]);
  await viewer.drag([0.4, 0.4], [90, 10]);

  await expectStep('3 of 5: Measure it');
  await button(viewer, 'Measure').click();

  await expectStep('4 of 5: Grade the stenosis');
  // Tracing has ended, so the bar is gone and the layout is as before.
  await expect(viewer.page.locator('.trace-bar')).toHaveCount(0);
  await expect(viewer.field('Context')).toHaveValue('mida');
  await expect(button(viewer, 'Confirm the suggested places')).toBeVisible();
  await viewer.screenshot('guide-4');
  expect(await serious()).toEqual([]);
  await button(viewer, 'Confirm the suggested places').click();
  await expect(stenosis(viewer)).toContainText(/5\d ± \d+ % of the diameter/);

  await expectStep('5 of 5: Save it');
  await menu(viewer).click();
  await viewer.screenshot('guide-5');
  const [download] = await Promise.all([
    viewer.page.waitForEvent('download'),
    button(viewer, REPORT).click(),
  ]);
  expect(download.suggestedFilename()).toMatch(/^lumencut-report-[\d-]+\.html$/);
  await button(viewer, 'Finish').click();
  await expect(guide()).toHaveCount(0);
});

test('the user leaves it in the middle, and the work is kept', async () => {
  await button(viewer, 'Skip this step').click();
  await expectStep('2 of 5: Turn it');
  const direction = async () => (await viewer.camera()).direction;
  const first = await direction();
  await viewer.drag([0.4, 0.4], [90, 10]);
  await expectStep('3 of 5: Measure it');
  await expect.poll(direction).not.toEqual(first);
  const turned = await direction();
  await button(viewer, 'Leave the tour').click();
  await expect(guide()).toHaveCount(0);
  await viewer.rest();
  expect(await direction()).toEqual(turned);
  await viewer.press('m');
  await expect(viewer.page.locator('main')).toHaveAttribute('data-layout', 'measure');
  await expect(guide()).toHaveCount(0);
  await button(viewer, 'Close the scan').click();
  await button(viewer, START).click();
  await expectStep('1 of 5: Trace the vessel');
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(0);
  await button(viewer, 'Close the scan').click();
  await expect(guide()).toHaveCount(0);
});
