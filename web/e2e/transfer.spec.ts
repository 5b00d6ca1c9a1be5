/** The transfer function of the context: points over the histogram, by mouse and by keys. */
import { expect, test } from '@playwright/test';
import { difference, SAME_CODE } from './compare';
import { Viewer } from './page';

test('points of a transfer function are dragged over the histogram, and by keys', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu');
  await viewer.rest();
  const changes = async (work: () => Promise<unknown>) => {
    const before = await viewer.pixels('turning');
    await work();
    await expect
      .poll(async () => difference(await viewer.pixels('turning'), before, SAME_CODE))
      .not.toBeNull();
    await viewer.rest();
  };
  const point = (n: number) => viewer.page.getByRole('slider', { name: new RegExp(`^Point ${n} of`) });
  await viewer.research(async () => {
    await viewer.field('Context').selectOption('dvr');
    await viewer.field('context transfer').selectOption('points');
    await expect(point(5)).toBeVisible();
    await viewer.rest();
    const before = await point(2).getAttribute('aria-valuetext');
    await point(2).hover();
    const box = await point(2).boundingBox();
    const [x, y] = [(box?.x ?? 0) + 6, (box?.y ?? 0) + 6];
    await viewer.page.mouse.move(x, y);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(x - 10, y - 25, { steps: 4 });
    await viewer.page.mouse.up();
    await expect(point(2)).not.toHaveAttribute('aria-valuetext', before ?? '');
    // The first point counts for all lower intensities, so that the air becomes opaque.
    await changes(async () => {
      await point(1).focus();
      await viewer.page.keyboard.press('Shift+ArrowUp');
      await viewer.page.keyboard.press('Shift+ArrowUp');
    });
    const opacity = await point(2).getAttribute('aria-valuetext');
    await point(2).focus();
    await viewer.page.keyboard.press('Shift+ArrowUp');
    await expect(point(2)).not.toHaveAttribute('aria-valuetext', opacity ?? '');
    await viewer.screenshot('transfer-points');
    await viewer.page.locator('.transfer').getByRole('button', { name: 'Add' }).click();
    await expect(point(6)).toBeVisible();
    await viewer.page.locator('.transfer').getByRole('button', { name: 'Remove' }).click();
    await expect(point(6)).toHaveCount(0);
    await changes(() => viewer.field('context transfer').selectOption('bone'));
    await expect(point(1)).toHaveCount(0);
  });
  viewer.expectNoFault();
  await viewer.close();
});
