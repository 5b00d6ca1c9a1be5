/** Suggested names of vessels: by mouse, keyboard and touch; only a click gives one to a vessel. */
import { expect, type Locator, test } from '@playwright/test';
import { button, nameOf, rename, rows, SIZE } from './controls';
import { Viewer } from './page';

const AORTA = '?phantom=aorta&device=cpu';

const suggested = (viewer: Viewer, words: string): Locator => button(viewer, `${words}?`);

/** The row whose vessel has this name. */
async function rowOf(viewer: Viewer, name: string): Promise<number> {
  const names = await rows(viewer)
    .locator('input.name')
    .evaluateAll((all) => all.map((one) => (one as HTMLInputElement).value));
  return names.indexOf(name);
}

test('a vessel without a name is offered one with a question mark; a click, Enter or a tap takes it', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, AORTA, { viewport: SIZE, hasTouch: true });
  await expect(viewer.pane()).toBeVisible();
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(50);
  const chip = suggested(viewer, 'Left renal artery');
  // A name without a number is that of a reader, so nothing is suggested.
  await expect(suggested(viewer, 'Abdominal aorta').first()).toBeVisible();
  await expect(chip).toHaveCount(0);
  // Only now, as lengths arrive with the suggestions, and order the rows.
  const row = await rowOf(viewer, 'left renal artery');
  await rename(viewer, row, 'Vessel 7');
  for (const take of [() => chip.click(), () => chip.press('Enter'), () => chip.tap()]) {
    await expect(nameOf(viewer, row)).toHaveValue('Vessel 7');
    await expect(chip).toBeVisible();
    await viewer.screenshot('names-suggested');
    await take();
    await expect(nameOf(viewer, row)).toHaveValue('Left renal artery');
    await expect(chip).toHaveCount(0);
    await button(viewer, 'Undo').click();
  }
  await expect(nameOf(viewer, row)).toHaveValue('Vessel 7');
  viewer.expectNoFault();
  await viewer.close();
});
