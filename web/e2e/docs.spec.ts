/** Opens the built documentation from files; checks that it loads nothing from other hosts and can be searched. */
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { expect, type Page, test } from '@playwright/test';

const SITE = process.env.LUMENCUT_DOCS_SITE ?? '';
const PAGES = ['index', 'gallery', 'start', 'python', 'api/pictures', 'method/cut-surface', 'comparison'];
const at = (name: string) => pathToFileURL(join(SITE, `${name}.html`)).href;

function recordFaults(page: Page): string[] {
  const faults: string[] = [];
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) faults.push(`asked ${request.url()}`);
  });
  page.on('console', (message) => faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  return faults;
}

for (const [width, height] of [
  [390, 844],
  [820, 1180],
  [1440, 900],
] as const) {
  test(`pages fit into ${width} × ${height}, whole and by themselves`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    const faults = recordFaults(page);
    for (const name of PAGES) {
      await page.goto(at(name));
      await expect(page.locator('h1')).toBeVisible();
      expect(await page.evaluate(() => document.documentElement.scrollWidth), name).toBeLessThanOrEqual(
        width,
      );
      const empty = page
        .locator('article img')
        .evaluateAll((all) =>
          all.filter((one) => (one as HTMLImageElement).naturalWidth === 0).map((one) => one.outerHTML),
        );
      expect(await empty, name).toEqual([]);
    }
    expect(faults).toEqual([]);
  });
}

test('the search finds a word without a server', async ({ page }) => {
  const faults = recordFaults(page);
  await page.goto(at('index'));
  await page.keyboard.press('/');
  await page.keyboard.type('untangled', { delay: 20 });
  await expect(page.locator('.md-search-result__meta')).toContainText('matching documents');
  await page.locator('.md-search-result__link').first().click();
  await expect(page.locator('article')).toContainText(/untangled/i);
  expect(faults).toEqual([]);
});

test('the code of a picture opens below it', async ({ page }) => {
  await page.goto(at('gallery'));
  const card = page.locator('.card').first();
  await card.locator('summary').click();
  await expect(card.locator('pre')).toContainText('import lumencut');
});
