/** Tests of the lumen shown at the pointer: a click selects it, and the wheel steps to lumens behind it. */
import { expect, test } from '@playwright/test';
import { button, expectBegun, rows, startTracing, untraced } from './controls';
import type { Viewer } from './page';

const inset = (viewer: Viewer, pane: 'turning' | 'coronal' = 'turning') =>
  viewer.pane(pane).getByTestId('lumen-inset');

test('in a slice the lumen under the pointer is shown next to it, in tissue nothing', async ({ browser }) => {
  const viewer = await untraced(browser);
  await startTracing(viewer);
  const [width, height] = await viewer.size('coronal');
  const hover = async (x: number, y: number) =>
    viewer.page.mouse.move(...(await viewer.place([Math.round(x), Math.round(y)], 'coronal')));
  await hover(width / 2, 0.8 * height);
  await expect(inset(viewer, 'coronal')).toContainText(/lumen, \d+\.\d mm\s*median \d+ HU/);
  await viewer.screenshot('lumen-inset-slice');
  await hover(width / 2 + 0.4 * height, 0.5 * height);
  await expect(inset(viewer, 'coronal')).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});

test('in a projection the nearest lumen is shown, Alt and the wheel step to the one behind, and a click selects it', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  await startTracing(viewer);
  // From the left, one branch is in front of the other.
  await viewer.press('l');
  await viewer.rest();
  const [x, y] = await viewer.place([0.5, 0.22]);
  await viewer.page.mouse.move(x, y);
  await expect(inset(viewer)).toContainText('1 of 2');
  await viewer.page.keyboard.down('Alt');
  await viewer.page.mouse.wheel(0, 110);
  await viewer.page.keyboard.up('Alt');
  await expect(inset(viewer)).toContainText('2 of 2');
  await viewer.screenshot('lumen-inset-ray');
  await viewer.click([0.5, 0.22]);
  // One click sets the point in the branch farther away, on the patient's right.
  await expectBegun(viewer);
  await expect(button(viewer, 'Set the point here')).toHaveCount(0);
  const [left] = await viewer.hair('coronal');
  const [width] = await viewer.size('coronal');
  expect(left).toBeLessThan(width / 2);
  await viewer.press('Enter');
  await expect(rows(viewer)).toHaveCount(1);
  viewer.expectNoFault();
  await viewer.close();
});
