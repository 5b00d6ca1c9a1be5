/** Tests of marked stretches of a vessel: length, C-arm angles, and the angle between two stretches. */
import { expect, test } from '@playwright/test';
import { PYTHON, SIZE } from './measured-tube';
import { Viewer } from './page';

test('while a vessel is measured its section is outdated; then a stretch, its C-arm angles, and the angle to another one', async ({
  browser,
}) => {
  const aorta = await Viewer.open(browser, '?phantom=aorta&device=cpu', { viewport: SIZE });
  await expect(aorta.pane('section')).toBeVisible();
  await aorta.rest();
  await aorta.press('m');
  const busy = aorta.pane('section').locator('.busy');
  const measuring = aorta.page.getByRole('progressbar', { name: 'Measuring the vessel' });
  await expect(measuring).toBeVisible();
  await aorta.wheel([0.5, 0.5], 120, 'section');
  await expect(busy).toBeVisible();
  await expect(measuring).toBeVisible();
  await aorta.screenshot('section-busy');
  await expect(measuring).toHaveCount(0);
  await expect(busy).toHaveCount(0);
  const mark = aorta.page.getByRole('button', { name: 'Mark a stretch' });
  await expect(mark).toBeVisible();
  const choice = aorta.page.getByRole('combobox', { name: /^Vessel \d/ });
  await choice.selectOption(await choice.inputValue());
  await mark.click();
  const [length, straight, tortuosity] = PYTHON.aorta.stretch;
  const stretch = aorta.page.getByTestId('stretch');
  await expect(stretch).toContainText(
    `length ${length.toFixed(1)} mm, straight ${straight.toFixed(1)} mm, tortuosity ${tortuosity.toFixed(3)}`,
  );
  await expect(stretch).toContainText(`C-arm ${PYTHON.aorta.c_arm}`);
  const before = await aorta.camera();
  await stretch.getByRole('button', { name: 'Turn the view there' }).click();
  expect((await aorta.camera()).direction).not.toEqual(before.direction);
  const chart = await aorta.page.getByTestId('chart').boundingBox();
  await aorta.page.mouse.click((chart?.x ?? 0) + 5, (chart?.y ?? 0) + 80);
  await aorta.page.getByRole('button', { name: 'Mark a second stretch' }).click();
  await expect(aorta.page.getByTestId('angle')).toHaveText(
    `Angle between both: ${Math.round(PYTHON.aorta.degrees)}°`,
  );
  await aorta.screenshot('stretches');
  aorta.expectNoFault();
  await aorta.close();
});
