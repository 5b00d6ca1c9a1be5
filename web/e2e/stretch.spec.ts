/** Tests of marked stretches of a vessel: length, C-arm angles, and the angle between two stretches. */
import { expect, test } from '@playwright/test';
import { SIZE } from './measured-tube';
import { Viewer } from './page';
import { arcOf, openBentTube } from './streams';

/** The marked stretches are quarters of the vessel, which bends by 90°: around its middle, and the first. */
const [MIDDLE, FIRST] = [
  [3 / 8, 5 / 8],
  [0, 1 / 4],
] as const;
const BETWEEN = 90 * (MIDDLE[0] - FIRST[0]);

test('while a vessel is measured its section is outdated; then a stretch, its C-arm angles, and the angle to another one', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  const { page } = viewer;
  await openBentTube(page);
  await expect(viewer.pane('section')).toBeVisible();
  await viewer.rest();
  const busy = viewer.pane('section').locator('.busy');
  const measuring = page.getByRole('progressbar', { name: 'Measuring the vessel' });
  // Looks at every picture of the page: a fast machine measures between two questions of the test.
  const both = page.waitForFunction(() =>
    ['[data-testid="section"] .busy', '[aria-label="Measuring the vessel"]'].every((one) =>
      document.querySelector(one),
    ),
  );
  await viewer.press('m');
  await viewer.wheel([0.5, 0.5], 120, 'section');
  await both;
  await expect(measuring).toHaveCount(0);
  await expect(busy).toHaveCount(0);
  const mark = page.getByRole('button', { name: 'Mark a stretch' });
  await expect(mark).toBeVisible();
  const choice = page.getByRole('combobox', { name: /^Vessel \d/ });
  await choice.selectOption(await choice.inputValue());
  await mark.click();
  const [vessel] = (await viewer.report()).vessels ?? [];
  const [line, whole] = [vessel?.line ?? -1, vessel?.length ?? 0];
  // The engine measures as Python does; see `tests/measuring.test.ts`.
  const expected = await viewer.ask('stretch', { line, ends: [MIDDLE[0] * whole, MIDDLE[1] * whole] });
  for (const [n, value] of arcOf(MIDDLE[1] - MIDDLE[0]).entries()) {
    const found = [expected.length, expected.straight, expected.tortuosity ?? 0][n] ?? 0;
    expect(Math.abs(found / value - 1)).toBeLessThan(1e-3);
  }
  const stretch = page.getByTestId('stretch');
  await expect(stretch).toContainText(
    `length ${expected.length.toFixed(1)} mm, straight ${expected.straight.toFixed(1)} mm, tortuosity ${expected.tortuosity?.toFixed(3)}`,
  );
  expect(expected.c_arm).toMatch(/^(LAO|RAO) \d+° (CRAN|CAUD) \d+°$/);
  await expect(stretch).toContainText(`C-arm ${expected.c_arm}`);
  const before = await viewer.camera();
  await stretch.getByRole('button', { name: 'Turn the view there' }).click();
  expect((await viewer.camera()).direction).not.toEqual(before.direction);
  const chart = await page.getByTestId('chart').boundingBox();
  await page.mouse.click((chart?.x ?? 0) + 5, (chart?.y ?? 0) + 80);
  await page.getByRole('button', { name: 'Mark a second stretch' }).click();
  await expect(page.getByTestId('angle')).toHaveText(`Angle between both: ${Math.round(BETWEEN)}°`);
  await viewer.screenshot('stretches');
  viewer.expectNoFault();
  await viewer.close();
});
