/** Measuring by mouse and by keyboard: the numbers are those of the Python package (`expected/make.py`). */
import { readFileSync } from 'node:fs';
import { AxeBuilder } from '@axe-core/playwright';
import { expect, type Locator, test } from '@playwright/test';
import { Viewer } from './page';

const file = (name: string) => readFileSync(new URL(`./expected/${name}`, import.meta.url), 'utf-8');
const PYTHON = JSON.parse(file('measuring.json'));
const SIZE = { width: 1280, height: 800 };

let viewer: Viewer;
test.beforeAll(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu', {
    viewport: SIZE,
    acceptDownloads: true,
  });
  await viewer.rest();
  await viewer.press('m');
  await expect(row('place-0')).toBeVisible();
});
test.afterEach(() => viewer.expectNoFault());
test.afterAll(() => viewer.close());

const row = (name: string): Locator => viewer.page.getByTestId(`row-${name}`);
const stenosis = (): Locator => viewer.page.getByTestId('stenosis');
const button = (name: string | RegExp): Locator => viewer.page.getByRole('button', { name });
const handle = (place: string, where: string): Locator => button(new RegExp(`^${place}.*, ${where}$`));

async function middleOf(locator: Locator): Promise<[number, number]> {
  const box = await locator.boundingBox();
  if (!box) {
    throw new Error('it is not shown');
  }
  return [box.x + box.width / 2, box.y + box.height / 2];
}

/** Drags a handle by so many pixels. */
async function dragBy(of: Locator, [dx, dy]: readonly [number, number]): Promise<void> {
  const { mouse } = viewer.page;
  const [x, y] = await middleOf(of);
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + dx / 2, y + dy / 2, { steps: 3 });
  await mouse.move(x + dx, y + dy, { steps: 3 });
  await mouse.up();
}

/** Pixels of the chart for so many mm along the vessel of 60 mm. */
async function pixels(mm: number): Promise<number> {
  const [from, to] = await Promise.all([middleOf(tick('0')), middleOf(tick('60'))]);
  return ((to[0] - from[0]) * mm) / 60;
}
const tick = (text: string): Locator =>
  viewer.page.locator('.profile-chart text[text-anchor=middle]', { hasText: new RegExp(`^${text}$`) });

/** Nothing is marked: all that was done before is undone. */
async function nothingMarked(): Promise<void> {
  for (const name of ['place-0', 'reference-0', 'reference-1']) {
    const remove = row(name).getByRole('button', { name: /^Remove/ });
    if (await remove.isVisible()) {
      await remove.click();
    }
  }
  await expect(row('place-0')).toContainText('(suggestion)');
}

/** The stenosis at 30 mm, with references at 10 and 50 mm, moved there by keys alone. */
async function marked(): Promise<void> {
  await nothingMarked();
  await handle('narrowest place', 'in the profile').focus();
  for (let n = 0; n < 5; n++) {
    await viewer.press('ArrowLeft');
  }
  await expect(row('place-0')).toContainText('at 30.0 mm');
  await handle('reference before', 'in the CPR').focus();
  await viewer.press('Shift+ArrowLeft', 'Shift+ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'ArrowLeft');
  await handle('reference after', 'on the vessel').focus();
  await viewer.press('Shift+ArrowDown', 'Shift+ArrowDown', 'ArrowRight', 'ArrowDown', 'ArrowDown');
  await expect(row('reference-0')).toContainText('at 10.0 mm');
  await expect(row('reference-1')).toContainText('at 50.0 mm');
}

test('measuring begins at the narrowest place, with the section and with the cross-hair', async () => {
  const [at] = PYTHON.narrowest;
  await expect(viewer.page.getByTestId('section-numbers')).toContainText(`${at.toFixed(1)} mm`);
  await expect(viewer.readOut).toContainText(`${at.toFixed(1)} mm`);
});

test('places are suggested, and nothing is graded before a reader marks one', async () => {
  await nothingMarked();
  const [at, diameter] = PYTHON.narrowest;
  await expect(row('place-0')).toContainText(`${diameter.toFixed(2)} ± `);
  await expect(row('place-0')).toContainText(` at ${at.toFixed(1)} mm`);
  for (const [slot, [place]] of PYTHON.references.entries()) {
    await expect(row(`reference-${slot}`)).toContainText(`at ${place.toFixed(1)} mm`);
  }
  await expect(stenosis()).toContainText('Nothing is marked');
  await expect(viewer.page.getByTestId('numbers')).not.toContainText('%');
  await expect(viewer.page.getByTestId('numbers')).toContainText(
    `${PYTHON.widest[1].toFixed(2)} mm at ${PYTHON.widest[0].toFixed(1)} mm`,
  );
});

test('by keys alone: the stenosis is that of Python', async () => {
  await marked();
  await expect(stenosis()).toHaveText(PYTHON.nascet);
  await viewer.screenshot('measuring');
});

test('each place can be dragged in the profile, the CPR and on the vessel, and moves in all of them', async () => {
  await nothingMarked();
  const three = async (name: string, at: string) => {
    for (const where of ['in the profile', 'in the CPR', 'on the vessel']) {
      await expect(handle(`${name}, ${at} mm`, where)).toBeVisible();
    }
  };
  await dragBy(handle('narrowest place', 'in the profile'), [await pixels(-2.5), 0]);
  await three('marked place', '30.0');
  await dragBy(handle('reference before', 'in the CPR'), [await pixels(-11.5), 12]);
  await three('reference before', '10.0');
  // On the vessel, which runs downwards from its first point at the feet: upwards in this view.
  const [, low] = await middleOf(handle('marked place', 'on the vessel'));
  const [, high] = await middleOf(handle('reference before', 'on the vessel'));
  const [, from] = await middleOf(handle('reference after', 'on the vessel'));
  const perMm = (low - high) / 20;
  const target = low + 20 * perMm;
  await dragBy(handle('reference after', 'on the vessel'), [3, target - from]);
  await three('reference after', '50.0');
  await expect(stenosis()).toHaveText(PYTHON.nascet);
});

/** The arc length that a row tells (mm). */
async function arcLength(name: string): Promise<number> {
  return Number.parseFloat(/ at ([\d.]+) mm/.exec((await row(name).textContent()) ?? '')?.[1] ?? '');
}

test('one drag moves one place: a reference passes the stenosis, and stops there where one is behind', async () => {
  await nothingMarked();
  const main = await arcLength('place-0');
  const from = await arcLength('reference-1');
  const { mouse } = viewer.page;
  const [x, y] = await middleOf(handle('reference after', 'in the profile'));
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + (await pixels(12 - from)), y, { steps: 25 });
  await mouse.up();
  await expect(row('reference-0')).toContainText('at 12.0 mm');
  await expect(row('reference-0')).not.toContainText('(suggestion)');
  // On the side that it left there is no mark.
  await expect(row('reference-1')).toContainText('(suggestion)');
  const shown = [main, await arcLength('reference-1')];
  await button('Confirm the suggested places').click();
  await expect(stenosis()).toContainText('% of the diameter');
  expect([await arcLength('place-0'), await arcLength('reference-1')]).toEqual(shown);
  await expect(row('reference-0')).toContainText('at 12.0 mm');
  await dragBy(handle('reference after', 'in the CPR'), [await pixels(10 - (shown[1] ?? 0)), 0]);
  await expect(row('reference-1')).toContainText(`at ${main.toFixed(1)} mm`);
  await expect(row('reference-0')).toContainText('at 12.0 mm');
});

test('by keys a reference passes the stenosis too, and stays the one that has the focus', async () => {
  await nothingMarked();
  const steps = (await arcLength('reference-1')) - (await arcLength('place-0'));
  await handle('reference after', 'in the profile').focus();
  for (let n = 0; n < Math.ceil(steps / 5) + 2; n++) {
    await viewer.press('Shift+ArrowLeft');
  }
  await expect(row('reference-0')).not.toContainText('(suggestion)');
  await expect(row('reference-1')).toContainText('(suggestion)');
  await expect(viewer.page.locator(':focus')).toHaveAttribute('aria-label', /^reference before, /);
});

test('values change while a place is dragged, and Escape takes the drag back', async () => {
  await marked();
  const { mouse } = viewer.page;
  const [x, y] = await middleOf(handle('marked place', 'in the profile'));
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + (await pixels(-10)), y, { steps: 5 });
  await expect(row('place-0')).toContainText('at 20.0 mm');
  await expect(stenosis()).not.toHaveText(PYTHON.nascet);
  await viewer.press('Escape');
  await expect(stenosis()).toHaveText(PYTHON.nascet);
  await mouse.up();
  await expect(row('place-0')).toContainText('at 30.0 mm');
});

test('every step is undone and done again', async () => {
  await marked();
  await handle('marked place', 'in the profile').focus();
  await viewer.press('ArrowRight', 'ArrowRight');
  await dragBy(handle('reference after', 'in the CPR'), [await pixels(5), 0]);
  await expect(row('reference-1')).toContainText('at 55.0 mm');
  await viewer.press('Control+z');
  await expect(row('reference-1')).toContainText('at 50.0 mm');
  await viewer.press('Control+z', 'Control+z');
  await expect(stenosis()).toHaveText(PYTHON.nascet);
  await viewer.press('Control+Shift+Z');
  await expect(row('place-0')).toContainText('at 30.5 mm');
  await viewer.press('Control+z');
});

test('Enter takes a suggestion, Delete takes a mark away', async () => {
  await nothingMarked();
  await handle('narrowest place', 'in the CPR').focus();
  await viewer.press('Enter');
  await expect(row('place-0')).toContainText('marked place');
  await expect(stenosis()).toContainText('Mark a reference');
  await handle('marked place', 'in the CPR').focus();
  await viewer.press('Delete');
  await expect(row('place-0')).toContainText('(suggestion)');
});

test('by ECST an original diameter is asked for; by area the percentage is that of Python', async () => {
  await marked();
  const numbers = viewer.page.getByTestId('numbers');
  await numbers.getByLabel('Method').selectOption('ecst');
  await expect(stenosis()).toContainText('ECST needs the diameter');
  await numbers.getByLabel('Original diameter').fill('9');
  await numbers.getByLabel('Original diameter').press('Enter');
  await expect(stenosis()).toHaveText(PYTHON.ecst);
  await numbers.getByLabel('Method').selectOption('area');
  await expect(stenosis()).toHaveText(PYTHON.area);
  await numbers.getByLabel('Method').selectOption('nascet');
  await numbers.getByLabel('Groups').selectOption('carotid');
  await expect(stenosis()).toContainText('Group of the field: ');
  await numbers.getByLabel('Groups').selectOption('');
});

test('behind a near-occlusion there is no percentage', async () => {
  await marked();
  const numbers = viewer.page.getByTestId('numbers');
  await numbers.getByLabel('Other side').fill('12');
  await numbers.getByLabel('Other side').press('Enter');
  await expect(stenosis()).toContainText('No percentage');
  await expect(stenosis()).not.toContainText('%');
  await numbers.getByLabel('Other side').fill('');
  await numbers.getByLabel('Other side').press('Enter');
  await expect(stenosis()).toHaveText(PYTHON.nascet);
});

test('axe finds no serious fault, and the menu stays within a small window', async () => {
  await marked();
  const { page } = viewer;
  const { violations } = await new AxeBuilder({ page }).analyze();
  const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
  expect(serious.map(({ id }) => id)).toEqual([]);
  await page.setViewportSize({ width: 900, height: 620 });
  await page.locator('summary', { hasText: 'Save' }).click();
  const box = await page.locator('.menu[open] .menu-body').boundingBox();
  expect((box?.x ?? 0) + (box?.width ?? 1e9)).toBeLessThanOrEqual(900);
  await viewer.screenshot('measuring-small');
  await page.locator('summary', { hasText: 'Save' }).click();
  await page.setViewportSize(SIZE);
});

test('vessel and profile share their axis', async () => {
  const [canvas, from, to] = await Promise.all([
    viewer.page.locator('[data-testid=profile] canvas').boundingBox(),
    middleOf(tick('0')),
    middleOf(tick('60')),
  ]);
  // The middles of the first and of the last column are at the ends of the vessel.
  const half = (canvas?.width ?? 0) / ((await viewer.pixels('profile')).width * 2);
  expect(Math.abs((canvas?.x ?? 0) + half - from[0])).toBeLessThan(1);
  expect(Math.abs((canvas?.x ?? 0) + (canvas?.width ?? 0) - half - to[0])).toBeLessThan(1.5);
});

/** Pixels of the section view for 1 mm: 50 mm have room in it. */
const sectionPixels = async (): Promise<number> => Math.min(...(await viewer.size('section'))) / 50;

test('legend and reading stand apart', async () => {
  const [legend, reading] = await Promise.all([
    viewer.page.locator('.profile-chart .legend').boundingBox(),
    viewer.page.getByTestId('chart-reading').boundingBox(),
  ]);
  expect((legend?.y ?? 1e9) + (legend?.height ?? 1e9)).toBeLessThanOrEqual(reading?.y ?? 0);
});

test('the section shows its contour and its diameters', async () => {
  await marked();
  await row('place-0').getByRole('button', { name: 'marked place' }).first().click();
  const [line] = file('measuring.csv').match(/^0,tube,30,.*$/m) ?? [''];
  const [, , , diameter, deviation, shortest, longest] = line.split(',').map(Number);
  const numbers = viewer.page.getByTestId('section-numbers');
  await expect(numbers).toContainText(`diameter ${diameter?.toFixed(2)} ± ${deviation?.toFixed(2)} mm`);
  await expect(numbers).toContainText(`shortest ${shortest?.toFixed(2)} mm`);
  await expect(numbers).toContainText(`longest ${longest?.toFixed(2)} mm`);
  const contour = viewer.page.locator('.section-marks path').first();
  await expect(contour).toHaveAttribute('stroke', '#00e5ff');
  const perMm = await sectionPixels();
  const width = () => contour.evaluate((path: SVGPathElement) => path.getBBox().width);
  await expect.poll(async () => Math.abs((await width()) / perMm - (diameter ?? 0))).toBeLessThan(0.15);
});

test('a ruler measures between two clicks; its ends can be dragged, and it can be removed', async () => {
  await button('Ruler').click();
  const [x, y] = await viewer.place([0.5, 0.5], 'section');
  const perMm = await sectionPixels();
  await viewer.page.mouse.click(x - 6 * perMm, y);
  await viewer.page.waitForTimeout(400);
  await viewer.page.mouse.click(x + 6 * perMm, y);
  const ruler = viewer.page.getByTestId('ruler');
  const length = async () => Number.parseFloat((await ruler.locator('span').textContent()) ?? '');
  await expect(ruler).toBeVisible();
  expect(Math.abs((await length()) - 12)).toBeLessThan(0.4);
  await dragBy(button(/^end of ruler 1,.*in the section$/), [3 * perMm, 4 * perMm]);
  await expect.poll(async () => Math.abs((await length()) - Math.hypot(15, 4))).toBeLessThan(0.4);
  await viewer.screenshot('ruler');
  await button('Remove distance 1').click();
  await expect(ruler).toHaveCount(0);
});

test('the table and the JSON are those of Python', async () => {
  await marked();
  const table = await saved('Numbers of measured vessels (CSV)');
  expect(table.split('\n').map(withoutRounding)).toEqual(
    file('measuring.csv').split('\n').map(withoutRounding),
  );
  const told = JSON.parse(await saved('Numbers of measured vessels (JSON)'));
  expect(told.vessels[0].stenosis.method).toBe('nascet');
  expect(PYTHON.nascet).toContain(`${told.vessels[0].stenosis.percent.toFixed(0)} % of the diameter`);
});

/** A line of the table in which coordinates that are 0 but for rounding are 0: the last digits of those differ by the compiler. */
const withoutRounding = (line: string): string =>
  line
    .split(',')
    .map((cell) => (Math.abs(Number(cell)) < 1e-4 ? '0' : cell))
    .join();

/** What is saved by a button of the menu. */
async function saved(name: string): Promise<string> {
  const menu = viewer.page.locator('summary', { hasText: 'Save' });
  await menu.click();
  const [download] = await Promise.all([viewer.page.waitForEvent('download'), button(name).click()]);
  await expect(viewer.page.locator('.menu[open]')).toHaveCount(0);
  await expect(viewer.page.getByTestId('told')).toContainText(`Saved as ${download.suggestedFilename()}`);
  return readFileSync(await download.path(), 'utf-8');
}

test('the menu closes by Escape and by a press elsewhere', async () => {
  const menu = viewer.page.locator('summary', { hasText: 'Save' });
  const body = button('Session (JSON)');
  await marked();
  await menu.click();
  await expect(body).toBeVisible();
  expect(await viewer.page.locator('.menu[open] button').first().textContent()).toMatch(/^Report/);
  await viewer.press('Escape');
  await expect(body).not.toBeVisible();
  await expect(menu).toBeFocused();
  await menu.click();
  await expect(body).toBeVisible();
  await viewer.page.getByRole('heading', { name: 'Places' }).click();
  await expect(body).not.toBeVisible();
});

test('a report without a percentage says so where a place is marked, and what nobody looked at stands apart', async () => {
  await nothingMarked();
  await row('place-0').getByRole('button', { name: 'Confirm' }).click();
  const [download] = await Promise.all([viewer.page.waitForEvent('download'), button('Save report').click()]);
  const words = 'No percentage: a place is marked and not graded. Mark a reference';
  await expect(viewer.page.getByTestId('told')).toContainText(`Saved as lumencut-report.html. ${words}`);
  const html = readFileSync(await download.path(), 'utf-8');
  expect(html).toContain(words);
  expect(html).toMatch(/Saved on \d{4}-\d\d-\d\d \d\d:\d\d/);
  const [looked = '', offered = ''] = html.split('Suggestions, not looked at');
  expect(looked).toContain('marked place</td>');
  expect(looked).not.toContain('reference before</td>');
  expect(offered).toContain('reference before</td>');
  await marked();
});

test('the report opens offline, on one page of paper', async ({ browser }) => {
  await marked();
  const html = await saved('Report of the vessel (HTML)');
  expect(html).not.toMatch(/:\/\/|<script/);
  expect(html).not.toContain('phantom stenosis');
  const page = await browser.newPage({ viewport: { width: 900, height: 1200 }, offline: true });
  const requests: string[] = [];
  page.on('request', (request) => requests.push(request.url()));
  await page.setContent(html);
  expect(requests.filter((address) => !address.startsWith('data:'))).toEqual([]);
  await expect(page.locator('body')).toContainText(PYTHON.nascet);
  await expect(page.locator('body')).toContainText('Lumencut is not a medical device.');
  const widths = await page
    .locator('img')
    .evaluateAll((images) => images.map((image) => (image as HTMLImageElement).naturalWidth));
  expect(widths).toHaveLength(4);
  expect(widths.every((width) => width > 100)).toBe(true);
  await page.screenshot({ path: 'test-results/screens/report.png', fullPage: true });
  const paper = (await page.pdf({ format: 'A4' })).toString('latin1');
  expect(paper.match(/\/Type \/Page\b/g)).toHaveLength(1);
  await page.close();
});

test('the name of the scan is in the report where it is ticked', async () => {
  await viewer.page.locator('summary', { hasText: 'Save' }).click();
  await viewer.page.getByLabel('with the name of the scan').check();
  await viewer.page.locator('summary', { hasText: 'Save' }).click();
  expect(await saved('Report of the vessel (HTML)')).toContain('Scan: phantom stenosis');
});

test('another width of the point spread is reckoned with, and said', async () => {
  const blur = viewer.page.getByRole('region', { name: 'Blur of the scan' });
  await expect(blur).toContainText('estimated on');
  await blur.getByLabel('Give it').fill('0.6');
  await blur.getByLabel('Give it').press('Enter');
  await expect(blur).toContainText(', given.');
  await blur.getByLabel('Give it').fill('');
  await blur.getByLabel('Give it').press('Enter');
  await expect(blur).toContainText('estimated on');
});

test('a stretch, its C-arm angles, and the angle to another one', async ({ browser }) => {
  // The phantom is a large one, and its longest vessel is measured.
  test.setTimeout(90_000);
  const aorta = await Viewer.open(browser, '?phantom=aorta&device=cpu', { viewport: SIZE });
  await expect(aorta.pane('section')).toBeVisible({ timeout: 30_000 });
  await aorta.press('m');
  const mark = aorta.page.getByRole('button', { name: 'Mark a stretch' });
  await expect(mark).toBeVisible({ timeout: 30_000 });
  // Half way along it, as the stretch of Python.
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

test('what was not saved is not closed unasked, and measuring does not go on in the next scan', async ({
  browser,
}) => {
  const tube = await Viewer.open(browser, '?phantom=stenosis&device=cpu', { viewport: SIZE });
  const { page } = tube;
  await tube.rest();
  const close = page.getByRole('button', { name: 'Close the scan' });
  const question = page.getByRole('alertdialog');
  await tube.press('m');
  await page.getByRole('button', { name: 'Confirm the suggested places' }).click();
  await expect(page.getByTestId('stenosis')).toContainText('% of the diameter');
  await close.click();
  await expect(question).toContainText('Discard changes that were not saved?');
  await expect(question.getByRole('button', { name: 'Go back' })).toBeFocused();
  await tube.press('Escape');
  await expect(question).toHaveCount(0);
  await expect(page.getByTestId('stenosis')).toContainText('% of the diameter');
  await page.getByRole('button', { name: 'Ruler' }).click();
  await close.click();
  await question.getByRole('button', { name: 'Discard' }).click();
  await expect(page.getByRole('heading', { name: 'Lumencut' })).toBeVisible();
  await page.getByRole('button', { name: 'A tube with a narrowing of 50 %' }).click();
  await expect(page.locator('main.layout')).toHaveAttribute('data-layout', 'strip');
  await tube.rest();
  await expect(page.getByRole('alert')).toHaveCount(0);
  // Nothing was done since: it closes at once, as it does where a tool is still in hand.
  await tube.press('m', 't');
  await expect(page.locator('main.layout')).toHaveAttribute('data-layout', 'four');
  await close.click();
  await page.getByRole('button', { name: 'A tube with a narrowing of 50 %' }).click();
  await expect(page.locator('main.layout')).toHaveAttribute('data-layout', 'strip');
  await expect(page.getByRole('button', { name: 'Trace vessels' })).toHaveAttribute('aria-pressed', 'false');
  await tube.rest();
  await expect(page.getByRole('alert')).toHaveCount(0);
  tube.expectNoFault();
  await tube.close();
});
