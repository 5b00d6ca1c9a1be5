/** The button offered by the page finds all vessels of a scan, as one undo step; the tree is cleaned afterwards. */
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from '@playwright/test';
import { button, rows, SIZE, untraced } from './controls';
import { Viewer } from './page';

const python = process.env.LUMENCUT_PYTHON ?? join(import.meta.dirname, '../../.venv/bin/python');

test('a page without vessels offers to find all of them, in one step that can be undone', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  await button(viewer, 'Find all vessels').last().click();
  await expect.poll(() => rows(viewer).count()).toBeGreaterThan(1);
  const count = await rows(viewer).count();
  await expect(button(viewer, 'Find all vessels')).toHaveCount(1);
  await viewer.screenshot('find-vessels');
  const notes = viewer.page.locator('footer summary');
  const note = viewer.page.locator('footer .menu-body li').first();
  for (const close of [() => viewer.press('Escape'), () => viewer.click([0.5, 0.1])]) {
    await notes.click();
    await expect(note).toBeVisible();
    await close();
    await expect(note).toBeHidden();
  }
  await expect(rows(viewer)).toHaveCount(count);
  await viewer.press('Control+z');
  await expect(rows(viewer)).toHaveCount(0);
  await viewer.press('Control+y');
  await expect(rows(viewer)).toHaveCount(count);
  viewer.expectNoFault();
  await viewer.close();
});

test('a search is refused or stopped; then all vessels are found, and the tree is cleaned', async ({
  browser,
}, testInfo) => {
  test.skip(!existsSync(python), 'there is no Python package beside the repository');
  const volume = testInfo.outputPath('volume');
  const made = spawnSync(python, [join(import.meta.dirname, 'stream.py'), 'aorta', volume], {
    encoding: 'utf-8',
  });
  expect(made.stderr).toBe('');
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  await viewer.page.route('**/made/volume', (route) => route.fulfill({ path: volume }));
  await viewer.page.goto('./?volume=made/volume&device=cpu');
  await viewer.rest();
  await viewer.press('v');
  const doubtful = () => viewer.page.locator('.doubtful-rows li');

  await test.step('searching branches from a point outside lumen or in a doubtful vessel is rejected at once', async () => {
    for (const [row, words, expected] of [
      [0.66, /P 6\d\./, 'expected lumen'],
      [0.57, /P [23]\d\./, 'expected one that is sure'],
    ] as const) {
      await viewer.click([0.52, row], 'axial');
      await expect(viewer.readOut).toContainText(words);
      await viewer.press('b');
      await expect(viewer.problem).toContainText(expected);
      await viewer.screenshot(`no-lumen-${row}`);
      await viewer.press('Escape');
      await expect(viewer.problem).toHaveCount(0);
    }
    await expect(rows(viewer)).toHaveCount(0);
  });

  await test.step('finding vessels shows its progress, and Escape stops it', async () => {
    await button(viewer, 'Find all vessels').last().click();
    await expect(viewer.page.getByRole('progressbar')).toBeVisible();
    await expect(viewer.page.getByText('Finding vessels')).toBeVisible();
    await viewer.press('Escape');
    await expect(viewer.page.getByRole('progressbar')).toHaveCount(0);
    await expect(rows(viewer)).toHaveCount(0);
    await expect(button(viewer, 'Find all vessels').last()).toBeEnabled();
  });

  const [sure, unsure] =
    await test.step('all vessels are found as a tree; doubtful ones are accepted or left out', async () => {
      await button(viewer, 'Find all vessels').last().click();
      const show = button(viewer, 'Show them');
      await expect(show).toBeVisible({ timeout: 150_000 });
      await expect(viewer.page.locator('.doubtful-rows h3')).toHaveText(/^\d+ doubtful, left out$/);
      await expect(doubtful()).toHaveCount(0);
      await expect(viewer.pane('axial').locator('.curve.doubtful')).toHaveCount(0);
      await show.click();
      await expect(doubtful().first()).toBeVisible();
      expect(await viewer.pane('axial').locator('.curve.doubtful').count()).toBeGreaterThan(0);
      const [sure, unsure] = [await rows(viewer).count(), await doubtful().count()] as const;
      expect(sure).toBeGreaterThan(3);
      await expect(viewer.page.getByLabel('As a tree, the widest first')).toBeChecked();
      await expect(rows(viewer).first().locator('.length')).toHaveText(/^[\d.]+ × \d+$/);
      const calibres = (await rows(viewer).locator('.length').allTextContents()).map(Number.parseFloat);
      expect(calibres[0]).toBe(Math.max(...calibres));
      await expect(rows(viewer).nth(1)).toHaveAttribute('data-depth', '1');
      const first = doubtful().first();
      await first.getByRole('button', { name: /^Accept/ }).click();
      await expect(rows(viewer)).toHaveCount(sure + 1);
      await expect(doubtful()).toHaveCount(unsure - 1);
      await first.getByRole('button', { name: /^Leave/ }).click();
      await expect(doubtful()).toHaveCount(unsure - 2);
      await button(viewer, 'Leave all out').click();
      await expect(doubtful()).toHaveCount(0);
      await viewer.press('Control+z', 'Control+z', 'Control+z');
      await expect(doubtful()).toHaveCount(unsure);
      await expect(rows(viewer)).toHaveCount(sure);
      await viewer.screenshot('find-doubtful');
      return [sure, unsure];
    });

  await test.step('the tree is cleaned in a few actions: short vessels by a slider, doubtful branches by keys', async () => {
    await viewer.page.getByText('Clean up', { exact: true }).click();
    const marked = viewer.page.locator('.vessel-rows .marked');
    await expect(marked).toHaveCount(0);
    await expect(button(viewer, 'Remove marked vessels')).toBeDisabled();
    await viewer.page.getByRole('spinbutton', { name: 'Shorter than' }).fill('40');
    await expect(viewer.page.getByRole('slider', { name: 'Shorter than' })).toHaveValue('40');
    const short = await marked.count();
    expect(short).toBeGreaterThan(0);
    expect(short).toBeLessThan(sure);
    await expect(viewer.pane().locator('.curve.marked')).toHaveCount(short);
    await viewer.screenshot('clean-marked');
    await button(viewer, short === 1 ? 'Remove 1 vessel' : `Remove ${short} vessels`).click();
    await expect(rows(viewer)).toHaveCount(sure - short);
    await expect(marked).toHaveCount(0);

    await rows(viewer).first().hover();
    await expect(viewer.pane().locator('.curve.lit')).toHaveCount(1);

    await viewer.pane().focus();
    const before = await viewer.camera();
    await viewer.press('.');
    const bar = viewer.page.locator('.trace-bar.over');
    await expect(bar).toContainText(`1 of ${unsure}`);
    await expect(bar).toContainText('is doubtful: ');
    await expect.poll(async () => (await viewer.camera()).center).not.toEqual(before.center);
    await viewer.screenshot('clean-doubt');
    await viewer.press('y');
    await expect(doubtful()).toHaveCount(unsure - 1);
    await expect(rows(viewer)).toHaveCount(sure - short + 1);
    await expect(bar).toContainText(`1 of ${unsure - 1}`);
    await viewer.press('n');
    await expect(doubtful()).toHaveCount(unsure - 2);
    await expect(bar).toContainText(`1 of ${unsure - 2}`);
    await viewer.press('Escape');
    await expect(bar).toHaveCount(0);
    await viewer.press('Control+z', 'Control+z', 'Control+z');
    await expect(rows(viewer)).toHaveCount(sure);
    await expect(doubtful()).toHaveCount(unsure);
  });
  viewer.expectNoFault();
  await viewer.close();
});
