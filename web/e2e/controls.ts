/** Actions that the tests of vessels, measurements and sessions share. */
import { readFileSync } from 'node:fs';
import { type Browser, type BrowserContextOptions, expect, type Locator } from '@playwright/test';
import { Viewer } from './page';

export const rows = (viewer: Viewer): Locator => viewer.page.locator('aside > .vessel-rows > li');
export const nameOf = (viewer: Viewer, n: number): Locator => rows(viewer).nth(n).locator('input.name');
export const listAsTheyCame = (viewer: Viewer): Promise<void> =>
  viewer.page.getByLabel(/^As a tree/).uncheck();

export async function rename(viewer: Viewer, n: number, name: string): Promise<void> {
  await nameOf(viewer, n).press('F2');
  await nameOf(viewer, n).fill(name);
  await nameOf(viewer, n).press('Tab');
}
export const button = (viewer: Viewer, words: string): Locator =>
  viewer.page.getByRole('button', { name: words, exact: true });
export const SIZE = { width: 1100, height: 720 };

export async function untraced(
  browser: Browser,
  phantom = 'y_junction',
  options: BrowserContextOptions = {},
): Promise<Viewer> {
  const viewer = await Viewer.open(browser, `?phantom=${phantom}&device=cpu`, { viewport: SIZE, ...options });
  await expect(viewer.pane()).toBeVisible();
  await viewer.press('v');
  const all = viewer.page.getByRole('button', { name: 'Delete all' });
  const one = viewer.page.getByRole('button', { name: 'Delete', exact: true });
  await ((await all.count()) > 0 ? all : one).click();
  await expect(rows(viewer)).toHaveCount(0);
  return viewer;
}

const traceTool = (viewer: Viewer): Locator =>
  viewer.page.locator('header').getByRole('button', { name: 'Trace', exact: true });
export async function startTracing(viewer: Viewer): Promise<void> {
  await traceTool(viewer).click();
  await expect(viewer.pane('coronal').locator('canvas[data-shown]')).toBeVisible();
}

export const expectBegun = (viewer: Viewer): Promise<void> =>
  expect(viewer.page.locator('[data-place=first]')).toHaveCount(4);

export const stenosis = (viewer: Viewer): Locator => viewer.page.getByTestId('stenosis');
export const menu = (viewer: Viewer): Locator => viewer.page.locator('summary', { hasText: 'Save' });

export const REPORT = 'Report (HTML)';
export const SESSION = 'Session (JSON)';

export interface MadeFile {
  readonly name: string;
  readonly mimeType: string;
  readonly buffer: Buffer;
}

export const fileOf = (name: string, buffer: Buffer): MadeFile => ({
  name,
  mimeType: 'application/octet-stream',
  buffer,
});

/** Saves by a button of the menu "Save". Checks that the menu closes and that the reported name is right. */
export async function saved(viewer: Viewer, words: string): Promise<Buffer> {
  const { page } = viewer;
  await menu(viewer).click();
  const [download] = await Promise.all([page.waitForEvent('download'), button(viewer, words).click()]);
  await expect(page.locator('.menu[open]')).toHaveCount(0);
  await expect(page.getByTestId('told')).toContainText(`Saved as ${download.suggestedFilename()}`);
  return readFileSync(await download.path());
}

export async function choose(viewer: Viewer, ...files: readonly MadeFile[]): Promise<void> {
  await viewer.page
    .locator('header input[type=file], main input[type=file]')
    .first()
    .setInputFiles([...files]);
}

export async function drop(viewer: Viewer, ...files: readonly MadeFile[]): Promise<void> {
  const given = files.map(({ name, buffer }) => [name, buffer.toString('base64')] as const);
  const transfer = await viewer.page.evaluateHandle((all) => {
    const made = new DataTransfer();
    for (const [name, text] of all) {
      made.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
    }
    return made;
  }, given);
  await viewer.page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
}

export async function countInput(viewer: Viewer): Promise<() => Promise<{ clicks: number; keys: number }>> {
  await viewer.page.evaluate(() => {
    const counts = { clicks: 0, keys: 0 };
    const count = (name: keyof typeof counts) => (event: Event) => {
      counts[name] += event.isTrusted ? 1 : 0;
    };
    addEventListener('pointerdown', count('clicks'), true);
    addEventListener('keydown', count('keys'), true);
    Object.assign(window, { counted: counts });
  });
  return () =>
    viewer.page.evaluate(() => (window as unknown as { counted: { clicks: number; keys: number } }).counted);
}

/** Presses Tab, or Shift+Tab if `back`, until a control has the focus. */
export async function tabTo(viewer: Viewer, words: string | RegExp, back = false): Promise<void> {
  const wanted = new RegExp(words);
  const seen: string[] = [];
  for (let n = 0; n < 80; n++) {
    await viewer.press(back ? 'Shift+Tab' : 'Tab');
    const name = await viewer.page.evaluate(
      () => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? '',
    );
    if (wanted.test(name)) {
      return;
    }
    seen.push(name.slice(0, 30));
  }
  throw new Error(`Tab never reached ${wanted}; it reached ${seen.join(' | ')}`);
}

export async function traced(viewer: Viewer, count: number): Promise<void> {
  await expect(rows(viewer)).toHaveCount(count);
  await expect(viewer.page.locator('.trace-bar').getByText('Tracing …')).toHaveCount(0);
  const last = rows(viewer).nth(count - 1);
  await expect(last.getByRole('radio')).toBeChecked();
  await expect(last.locator('.length')).not.toHaveText('0.0 mm');
}
