/** Tests of the measurements shown in the panel, in the chart and in the section. */
import { AxeBuilder } from '@axe-core/playwright';
import { expect, test } from '@playwright/test';
import { menu } from './controls';
import { expected, MeasuredTube, PYTHON, SIZE } from './measured-tube';

let tube: MeasuredTube;
test.beforeAll(async ({ browser }) => {
  tube = await MeasuredTube.open(browser);
});
test.afterEach(() => tube.viewer.expectNoFault());

test('ECST requires an original diameter; the percentage by area equals that of the Python package', async () => {
  await tube.marked();
  const numbers = tube.viewer.page.getByTestId('numbers');
  await numbers.getByLabel('Method').selectOption('ecst');
  await expect(tube.stenosis()).toContainText('ECST needs the assumed original diameter');
  await numbers.getByLabel('Original diameter').fill('9');
  await numbers.getByLabel('Original diameter').press('Enter');
  await expect(tube.stenosis()).toHaveText(PYTHON.ecst);
  await numbers.getByLabel('Method').selectOption('area');
  await expect(tube.stenosis()).toHaveText(PYTHON.area);
  await numbers.getByLabel('Method').selectOption('nascet');
  await numbers.getByLabel('Severity group').selectOption('carotid');
  await expect(tube.stenosis()).toContainText('Severity group: ');
  await numbers.getByLabel('Severity group').selectOption('');
});

test('behind a near-occlusion there is no percentage', async () => {
  await tube.marked();
  const numbers = tube.viewer.page.getByTestId('numbers');
  await numbers.getByLabel('Contralateral').fill('12');
  await numbers.getByLabel('Contralateral').press('Enter');
  await expect(tube.stenosis()).toContainText('No percentage');
  await expect(tube.stenosis()).not.toContainText('%');
  await numbers.getByLabel('Contralateral').fill('');
  await numbers.getByLabel('Contralateral').press('Enter');
  await expect(tube.stenosis()).toHaveText(PYTHON.nascet);
});

test('axe finds no serious fault, and the menu stays within a small window', async () => {
  await tube.marked();
  const { page } = tube.viewer;
  const { violations } = await new AxeBuilder({ page }).analyze();
  const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
  expect(serious.map(({ id }) => id)).toEqual([]);
  await page.setViewportSize({ width: 900, height: 620 });
  await menu(tube.viewer).click();
  await expect(async () => {
    const box = await page.locator('.menu[open] .menu-body').boundingBox();
    expect((box?.x ?? 0) + (box?.width ?? 1e9)).toBeLessThanOrEqual(900);
  }).toPass();
  await tube.viewer.screenshot('measuring-small');
  await menu(tube.viewer).click();
  await page.setViewportSize(SIZE);
});

test('at 200 % no text covers the lumen, and no button covers a look', async () => {
  const { page } = tube.viewer;
  await expect(page.getByTestId('section-numbers')).toBeVisible();
  await page.setViewportSize({ width: 720, height: 450 });
  await expect(page.getByTestId('section-numbers')).toBeHidden();
  await expect(page.getByTestId('chart-reading')).toBeVisible();
  const [bar, look] = [page.locator('.looks'), page.getByRole('button', { name: 'Show Vessels alone' })];
  const [left, right] = [await bar.boundingBox(), await look.boundingBox()];
  expect((left?.x ?? 0) + (left?.width ?? 1e9)).toBeLessThanOrEqual(right?.x ?? 0);
  await tube.viewer.screenshot('measuring-200');
  await page.setViewportSize(SIZE);
});

test('vessel and profile share their axis', async () => {
  // Retried, because chart and picture are updated at different times.
  await expect(async () => {
    const [canvas, from, to] = await Promise.all([
      tube.viewer.page.locator('[data-testid=profile] canvas').boundingBox(),
      tube.middleOf(tube.tick('0')),
      tube.middleOf(tube.tick('60')),
    ]);
    // The first and last columns are centred on the ends of the vessel.
    const half = (canvas?.width ?? 0) / ((await tube.viewer.pixels('profile')).width * 2);
    expect(Math.abs((canvas?.x ?? 0) + half - from[0])).toBeLessThan(1);
    expect(Math.abs((canvas?.x ?? 0) + (canvas?.width ?? 0) - half - to[0])).toBeLessThan(1.5);
  }).toPass();
});

test('legend and read-out do not overlap', async () => {
  const [legend, reading] = await Promise.all([
    tube.viewer.page.locator('.profile-chart .legend').boundingBox(),
    tube.viewer.page.getByTestId('chart-reading').boundingBox(),
  ]);
  expect((legend?.y ?? 1e9) + (legend?.height ?? 1e9)).toBeLessThanOrEqual(reading?.y ?? 0);
});

test('the section shows its contour and its diameters', async () => {
  await tube.marked();
  await tube.row('place-0').getByRole('button', { name: 'marked place' }).first().click();
  const [line] = expected('measuring.csv').match(/^0,tube,30,.*$/m) ?? [''];
  const [, , , diameter, deviation, shortest, longest] = line.split(',').map(Number);
  const numbers = tube.viewer.page.getByTestId('section-numbers');
  await expect(numbers).toContainText(`diameter ${diameter?.toFixed(2)} ± ${deviation?.toFixed(2)} mm`);
  await expect(numbers).toContainText(`shortest ${shortest?.toFixed(2)} mm`);
  await expect(numbers).toContainText(`longest ${longest?.toFixed(2)} mm`);
  const contour = tube.viewer.page.locator('.section-marks path').first();
  await expect(contour).toHaveAttribute('stroke', '#00e5ff');
  const perMm = await tube.sectionPixels();
  const width = () => contour.evaluate((path: SVGPathElement) => path.getBBox().width);
  await expect.poll(async () => Math.abs((await width()) / perMm - (diameter ?? 0))).toBeLessThan(0.15);
});

test('a ruler measures between two clicks; its ends can be dragged, and it can be removed', async () => {
  await tube.button('Ruler').click();
  await expect(tube.button('Ruler')).toHaveAttribute('aria-pressed', 'true');
  const [x, y] = await tube.viewer.place([0.5, 0.5], 'section');
  const perMm = await tube.sectionPixels();
  await tube.viewer.page.mouse.click(x - 6 * perMm, y);
  await tube.viewer.page.mouse.click(x + 6 * perMm, y);
  const ruler = tube.viewer.page.getByTestId('ruler');
  const length = async () => Number.parseFloat((await ruler.locator('span').textContent()) ?? '');
  await expect(ruler).toBeVisible();
  expect(Math.abs((await length()) - 12)).toBeLessThan(0.4);
  await tube.dragBy(tube.button(/^end of ruler 1,.*in the section$/), [3 * perMm, 4 * perMm]);
  await expect.poll(async () => Math.abs((await length()) - Math.hypot(15, 4))).toBeLessThan(0.4);
  await tube.viewer.screenshot('ruler');
  await tube.button('Remove distance 1').click();
  await expect(ruler).toHaveCount(0);
});

test('another FWHM is used for measuring, and stated', async () => {
  const blur = tube.viewer.page.getByRole('region', { name: 'Blur of the scan' });
  await expect(blur).toContainText('assumed: ');
  await blur.getByLabel('Known FWHM').fill('0.6');
  await blur.getByLabel('Known FWHM').press('Enter');
  await expect(blur).toContainText(', given.');
  await blur.getByLabel('Known FWHM').fill('');
  await blur.getByLabel('Known FWHM').press('Enter');
  await expect(blur).toContainText('assumed: ');
});
