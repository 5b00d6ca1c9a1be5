/** The contact sheet of a cohort of 2,000 studies is opened from a file, filtered, sorted and rated. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { expect, type Page, test } from '@playwright/test';

const ROOT = join(import.meta.dirname, '../..');
const python = process.env.LUMENCUT_PYTHON ?? join(ROOT, '.venv/bin/python');
const COUNT = 2000;

let address: string;
test.beforeAll(() => {
  const folder = mkdtempSync(join(tmpdir(), 'lumencut-cohort-'));
  const made = spawnSync(python, [join(ROOT, 'tests/cohort_page.py'), folder, String(COUNT)], {
    encoding: 'utf-8',
  });
  expect(made.status, made.stderr).toBe(0);
  address = pathToFileURL(join(folder, 'index.html')).href;
});

const ids = (page: Page) =>
  page
    .locator('li:not(.hidden)')
    .evaluateAll((tiles) => tiles.map((tile) => (tile as HTMLElement).dataset.id));

test('two thousand studies are shown and filtered without an error', async ({ page }) => {
  const complaints: string[] = [];
  page.on('console', (message) => complaints.push(message.text()));
  await page.goto(address);
  await expect(page.getByRole('status')).toHaveText(`${COUNT} of ${COUNT} studies`);
  await page.selectOption('#filter', 'failed');
  await expect(page.getByRole('status')).toHaveText(`${COUNT / 10} of ${COUNT} studies`);
  expect(complaints).toEqual([]);
});

test('studies are filtered, sorted and rated, and the ratings remain after a reload', async ({ page }) => {
  await page.goto(address);
  await page.selectOption('#filter', 'failed');
  expect((await ids(page)).slice(0, 3)).toEqual(['p0', 'p10', 'p20']);
  await expect(page.locator('li').first()).toContainText('crashed: SIGABRT <b>bold</b>');
  await page.selectOption('#filter', 'all');
  await page.selectOption('#order', 'narrowest');
  const [narrowest] = await ids(page);
  expect(Number(narrowest?.slice(1)) % 100).toBe(73);
  await page.selectOption('#order', 'row');
  await page.fill('#search', 'p199');
  await page.locator('li:not(.hidden)').first().focus();
  // After the first tile is rated, the second one has the focus.
  await page.keyboard.press('g');
  await page.keyboard.press('x');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('r');
  await page.reload();
  const waiting = page.waitForEvent('download');
  await page.click('#save');
  const saved = readFileSync((await (await waiting).path()) ?? '', 'utf-8');
  expect(saved).toBe('id,rating\np199,good\np1990,redo\n');
  await page.selectOption('#filter', 'redo');
  expect(await ids(page)).toEqual(['p1990']);
  await page.selectOption('#filter', 'all');
  await page.fill('#search', '=p3');
  await page.locator('li:not(.hidden)').first().focus();
  await page.keyboard.press('x');
  const again = page.waitForEvent('download');
  await page.click('#save');
  const marked = readFileSync((await (await again).path()) ?? '', 'utf-8');
  expect(marked).toBe(`id,rating\n"'=p3,1",exclude\np199,good\np1990,redo\n`);
});

test('a click selects a tile; Enter and a double click open its picture in a new tab', async ({
  page,
  context,
}) => {
  await page.goto(address);
  const tile = page.locator('li[data-id="p4"]');
  await tile.locator('img').click();
  await expect(tile).toBeFocused();
  expect(page.url()).toBe(address);
  expect(context.pages()).toHaveLength(1);
  for (const act of [() => page.keyboard.press('Enter'), () => tile.locator('img').dblclick()]) {
    const opening = context.waitForEvent('page');
    await act();
    const opened = await opening;
    expect(opened.url()).toContain('sub-p4/sub-p4_view-anterior_desc-focus.png');
    await opened.close();
  }
  await expect(tile).toBeFocused();
  const failed = page.locator('li[data-id="p10"]');
  await failed.locator('a').dblclick();
  await expect(failed).toBeFocused();
  expect(page.url()).toBe(address);
  expect(context.pages()).toHaveLength(1);
});
