/** Places are marked by mouse and keys. The measurements are those of the Python package (`expected/make.py`). */
import { expect, test } from '@playwright/test';
import { MeasuredTube, PYTHON } from './measured-tube';

let tube: MeasuredTube;
test.beforeAll(async ({ browser }) => {
  tube = await MeasuredTube.open(browser);
});
test.afterEach(() => tube.viewer.expectNoFault());

test('places are suggested, and nothing is graded before the user marks one', async () => {
  await tube.nothingMarked();
  const [at] = PYTHON.narrowest;
  const [diameter] = PYTHON.diameter;
  await expect(tube.row('place-0')).toContainText(`${diameter.toFixed(2)} ± `);
  await expect(tube.row('place-0')).toContainText(` at ${at.toFixed(1)} mm`);
  for (const [slot, [place]] of PYTHON.references.entries()) {
    await expect(tube.row(`reference-${slot}`)).toContainText(`at ${place.toFixed(1)} mm`);
  }
  await expect(tube.stenosis()).toContainText('Nothing is marked');
  await expect(tube.viewer.page.getByTestId('numbers')).not.toContainText('%');
  await expect(tube.viewer.page.getByTestId('numbers')).toContainText(
    `${PYTHON.widest[1].toFixed(2)} mm at ${PYTHON.widest[0].toFixed(1)} mm`,
  );
});

test('by keys only: the stenosis equals that of the Python package', async () => {
  await tube.marked();
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
  await tube.viewer.screenshot('measuring');
});

test('each place can be dragged in the profile, the CPR and on the vessel, and moves in all of them', async () => {
  await tube.nothingMarked();
  const three = async (name: string, at: string) => {
    for (const where of ['in the profile', 'in the CPR', 'on the vessel']) {
      await expect(tube.handle(`${name}, ${at} mm`, where)).toBeVisible();
    }
  };
  await tube.dragBy(tube.handle('narrowest place', 'in the profile'), [
    await tube.pixels(30 - PYTHON.narrowest[0]),
    0,
  ]);
  await three('marked place', '30.0');
  await tube.dragBy(tube.handle('reference before', 'in the CPR'), [await tube.pixels(-11.5), 12]);
  await three('reference before', '10.0');
  // The first point is at the feet, so moving along the vessel is upwards here.
  const [, low] = await tube.middleOf(tube.handle('marked place', 'on the vessel'));
  const [, high] = await tube.middleOf(tube.handle('reference before', 'on the vessel'));
  const [, from] = await tube.middleOf(tube.handle('reference after', 'on the vessel'));
  const perMm = (low - high) / 20;
  const target = low + 20 * perMm;
  await tube.dragBy(tube.handle('reference after', 'on the vessel'), [3, target - from]);
  await three('reference after', '50.0');
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
});

test('a drag moves one place: a reference passes the stenosis unless another one lies behind it', async () => {
  await tube.nothingMarked();
  const main = await tube.arcLength('place-0');
  const from = await tube.arcLength('reference-1');
  const { mouse } = tube.viewer.page;
  const [x, y] = await tube.middleOf(tube.handle('reference after', 'in the profile'));
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + (await tube.pixels(12 - from)), y, { steps: 25 });
  await mouse.up();
  await expect(tube.row('reference-0')).toContainText('at 12.0 mm');
  await expect(tube.row('reference-0')).not.toContainText('(suggestion)');
  await expect(tube.row('reference-1')).toContainText('(suggestion)');
  const shown = [main, await tube.arcLength('reference-1')];
  await tube.button('Confirm the suggested places').click();
  await expect(tube.stenosis()).toContainText('% of the diameter');
  expect([await tube.arcLength('place-0'), await tube.arcLength('reference-1')]).toEqual(shown);
  await expect(tube.row('reference-0')).toContainText('at 12.0 mm');
  await tube.dragBy(tube.handle('reference after', 'in the CPR'), [
    await tube.pixels(10 - (shown[1] ?? 0)),
    0,
  ]);
  await expect(tube.row('reference-1')).toContainText(`at ${main.toFixed(1)} mm`);
  await expect(tube.row('reference-0')).toContainText('at 12.0 mm');
});

test('the stenosis passes its reference, and is not graded with one that lies within a diameter of it', async () => {
  await tube.marked();
  const dragTo = async (from: number, to: number) => {
    const handle = tube.handle(`marked place, ${from.toFixed(1)} mm`, 'in the profile');
    await tube.dragBy(handle, [await tube.pixels(to - from), 0]);
    await expect(tube.row('place-0')).toContainText(`at ${to.toFixed(1)} mm`);
  };
  await dragTo(30, 50);
  await expect(tube.stenosis()).toContainText('found 50.0 mm, 0.0 mm from the stenosis at 50.0 mm');
  await expect(tube.stenosis()).toContainText('at least one diameter of the vessel');
  await dragTo(50, 57);
  await expect(tube.stenosis()).toContainText('No percentage');
  await dragTo(57, 30);
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
});

test('a place and a reference are marked at the section that is shown', async () => {
  await tube.nothingMarked();
  await tube.row('reference-1').getByRole('button', { name: 'reference after' }).click();
  const at = await tube.arcLength('reference-1');
  await tube.button('Reference here').click();
  await expect(tube.row('reference-1')).not.toContainText('(suggestion)');
  await expect(tube.row('reference-1')).toContainText(`at ${at.toFixed(1)} mm`);
  await tube.row('place-0').getByRole('button', { name: 'narrowest place' }).click();
  await tube.button('Narrowest here').click();
  await expect(tube.stenosis()).toContainText('% of the diameter');
});

test('a third reference replaces the one on its side', async () => {
  await tube.nothingMarked();
  await tube.button(/^Confirm the suggested places/).click();
  const before = await tube.arcLength('reference-0');
  const chart = tube.viewer.page.getByTestId('chart');
  await chart.focus();
  await tube
    .row('reference-1')
    .getByRole('button', { name: /^reference after/ })
    .click();
  await chart.focus();
  await tube.viewer.press('Shift+ArrowLeft');
  const at = (await tube.arcLength('reference-1')) - 5;
  await tube.button('Reference here').click();
  await expect.poll(() => tube.arcLength('reference-1')).toBeCloseTo(at, 0);
  expect(await tube.arcLength('reference-0')).toBe(before);
});

test('a length begins at one section and ends at another, by the mouse or by keys', async () => {
  await tube.nothingMarked();
  const { page } = tube.viewer;
  const begin = tube.button('Length from here');
  await tube.row('reference-0').getByRole('button', { name: 'reference before' }).click();
  const from = await tube.arcLength('reference-0');
  await begin.click();
  const end = tube.button(/^Length to here: 0\.0 mm$/);
  await expect(end).toBeVisible();
  await page.getByTestId('chart').focus();
  await tube.viewer.press('Escape');
  await expect(begin).toBeVisible();
  await begin.focus();
  await tube.viewer.press('Enter');
  await page.getByTestId('chart').focus();
  await tube.viewer.press('Shift+ArrowRight', 'Shift+ArrowRight');
  await tube.button(/^Length to here: 10\.0 mm$/).click();
  await expect(page.getByTestId('stretch')).toContainText(
    `${from.toFixed(1)} to ${(from + 10).toFixed(1)} mm`,
  );
  await expect(begin).toBeVisible();
  await tube.viewer.press('Control+z');
  await expect(page.getByTestId('stretch')).toHaveCount(0);
});

test('by keys a reference passes the stenosis too, and stays the one that has the focus', async () => {
  await tube.nothingMarked();
  const steps = (await tube.arcLength('reference-1')) - (await tube.arcLength('place-0'));
  await tube.handle('reference after', 'in the profile').focus();
  for (let n = 0; n < Math.ceil(steps / 5) + 2; n++) {
    await tube.viewer.press('Shift+ArrowLeft');
  }
  await expect(tube.row('reference-0')).not.toContainText('(suggestion)');
  await expect(tube.row('reference-1')).toContainText('(suggestion)');
  await expect(tube.viewer.page.locator(':focus')).toHaveAttribute('aria-label', /^reference before, /);
});

test('values change while a place is dragged, and Escape undoes the drag', async () => {
  await tube.marked();
  const { mouse } = tube.viewer.page;
  const [x, y] = await tube.middleOf(tube.handle('marked place', 'in the profile'));
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + (await tube.pixels(-10)), y, { steps: 5 });
  await expect(tube.row('place-0')).toContainText('at 20.0 mm');
  await expect(tube.stenosis()).not.toHaveText(PYTHON.nascet);
  await tube.viewer.press('Escape');
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
  await mouse.up();
  await expect(tube.row('place-0')).toContainText('at 30.0 mm');
});

test('every step is undone and redone', async () => {
  await tube.marked();
  await tube.handle('marked place', 'in the profile').focus();
  await tube.viewer.press('ArrowRight', 'ArrowRight');
  await tube.dragBy(tube.handle('reference after', 'in the CPR'), [await tube.pixels(5), 0]);
  await expect(tube.row('reference-1')).toContainText('at 55.0 mm');
  await tube.viewer.press('Control+z');
  await expect(tube.row('reference-1')).toContainText('at 50.0 mm');
  await tube.viewer.press('Control+z', 'Control+z');
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
  await tube.viewer.press('Control+Shift+Z');
  await expect(tube.row('place-0')).toContainText('at 30.5 mm');
  await tube.viewer.press('Control+z');
});

test('Enter confirms a suggestion, Delete removes a mark', async () => {
  await tube.nothingMarked();
  await tube.handle('narrowest place', 'in the CPR').focus();
  await tube.viewer.press('Enter');
  await expect(tube.row('place-0')).toContainText('narrowest place (confirmed suggestion)');
  await expect(tube.stenosis()).toContainText('mark a reference');
  await tube.handle('narrowest place', 'in the CPR').focus();
  await tube.viewer.press('Delete');
  await expect(tube.row('place-0')).toContainText('(suggestion)');
});

test('a place can be dragged by its whole line, up to 20 pixels beside it; a miss changes nothing', async () => {
  await tube.marked();
  const box = await tube.viewer.page.getByTestId('chart').boundingBox();
  const [column] = await tube.middleOf(tube.tick('30'));
  const window = await tube.viewer.window.textContent();
  const { mouse } = tube.viewer.page;
  const drag = async (from: number, by: number) => {
    const row = (box?.y ?? 0) + (box?.height ?? 0) * 0.6;
    await mouse.move(from, row);
    await mouse.down();
    await mouse.move(from + by / 2, row, { steps: 3 });
    await mouse.move(from + by, row, { steps: 3 });
    await mouse.up();
  };
  await drag(column + 20, await tube.pixels(3));
  await expect(tube.row('place-0')).toContainText('at 33.0 mm');
  await tube.viewer.press('Control+z');
  await expect(tube.row('place-0')).toContainText('at 30.0 mm');

  // A click acts on the chart; a drag that begins far from all lines moves only the section.
  await mouse.click(column + 10, (box?.y ?? 0) + (box?.height ?? 0) * 0.6);
  await drag(column + (await tube.pixels(10)), await tube.pixels(2));
  await expect(tube.row('place-0')).toContainText('at 30.0 mm');
  await expect(tube.row('reference-1')).toContainText('at 50.0 mm');
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
  expect(await tube.viewer.window.textContent()).toBe(window);
});

test('handles on the vessel can be dragged from 20 pixels beside their centre', async () => {
  await tube.marked();
  const grip = tube.handle('marked place', 'on the vessel');
  const [x, y] = await tube.middleOf(grip);
  const before = await tube.viewer.camera();
  const { mouse } = tube.viewer.page;
  await mouse.move(x + 19, y);
  await mouse.down();
  await mouse.move(x + 19, y + 20, { steps: 5 });
  await mouse.up();
  await expect(tube.row('place-0')).not.toContainText('at 30.0 mm');
  expect(await tube.viewer.camera()).toEqual(before);
  await tube.viewer.press('Control+z');
  await expect(tube.row('place-0')).toContainText('at 30.0 mm');
});
