/** Tests of the files that are saved for a measured vessel: CSV table, JSON and report. */
import { readFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import { menu, REPORT, SESSION } from './controls';
import { expected, MeasuredTube, PYTHON } from './measured-tube';

let tube: MeasuredTube;
test.beforeAll(async ({ browser }) => {
  tube = await MeasuredTube.open(browser);
});
test.afterEach(() => tube.viewer.expectNoFault());

test('the table and the JSON equal those of the Python package', async () => {
  await tube.marked();
  const table = await tube.saved('Measurements of all measured vessels (CSV)');
  expect(table.split('\n').map(withoutRounding)).toEqual(
    expected('measuring.csv').split('\n').map(withoutRounding),
  );
  const told = JSON.parse(await tube.saved('Measurements of all measured vessels (JSON)'));
  expect(told.vessels[0].stenosis.method).toBe('nascet');
  expect(PYTHON.nascet).toContain(`${told.vessels[0].stenosis.percent.toFixed(0)} ± 1 % of the diameter`);
});

/** Replaces coordinates that are 0 up to rounding errors, which depend on the compiler. */
const withoutRounding = (line: string): string =>
  line
    .split(',')
    .map((cell) => (Math.abs(Number(cell)) < 1e-4 ? '0' : cell))
    .join();

test('the menu closes by Escape and by a press elsewhere', async () => {
  const save = menu(tube.viewer);
  const body = tube.button(SESSION);
  await tube.marked();
  await save.click();
  await expect(body).toBeVisible();
  expect(await tube.viewer.page.locator('.menu[open] button').first().textContent()).toMatch(/^Report/);
  await tube.viewer.press('Escape');
  await expect(body).not.toBeVisible();
  await expect(save).toBeFocused();
  await save.click();
  await expect(body).toBeVisible();
  await tube.viewer.page.getByRole('heading', { name: 'Places' }).click();
  await expect(body).not.toBeVisible();
});

test('a report of a marked place without a percentage says so, and lists suggestions separately', async () => {
  await tube.nothingMarked();
  await tube.row('place-0').getByRole('button', { name: 'Confirm' }).click();
  const [download] = await Promise.all([
    tube.viewer.page.waitForEvent('download'),
    tube.button('Save report').click(),
  ]);
  const words = 'No percentage: mark a reference where the vessel is normal.';
  await expect(tube.viewer.page.getByTestId('told')).toHaveText(
    /\.html\. 3\.98 ± 0\.02 mm at 32\.5 mm\. No percentage: mark a reference where the vessel is normal\.$/,
  );
  const html = readFileSync(await download.path(), 'utf-8');
  expect(html).toContain(words);
  expect(html).toMatch(/Saved on \d{4}-\d\d-\d\d \d\d:\d\d/);
  const [looked = '', offered = ''] = html.split('Suggestions, not confirmed');
  expect(looked).toContain('narrowest place (confirmed suggestion)</td>');
  expect(looked).not.toContain('reference before');
  expect(offered).toContain('reference before (suggestion)</td>');
  await tube.marked();
});

test('the report opens offline, on one page of paper', async ({ browser }) => {
  await tube.marked();
  const html = await tube.saved(REPORT);
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

test('the name of the scan is in the report if the user chooses so', async () => {
  const include = async (name: boolean) => {
    await menu(tube.viewer).click();
    await tube.viewer.page.getByLabel('include the name of the scan').setChecked(name);
    await menu(tube.viewer).click();
  };
  await include(true);
  expect(await tube.saved(REPORT)).toMatch(/<h1>phantom stenosis – /);
  await include(false);
});
