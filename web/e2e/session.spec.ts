/** A session file restores all work of the user, in the page and on the command line. */
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { type Browser, expect, test } from '@playwright/test';
import { difference, OTHER_DEVICE, OTHER_SAMPLES } from './compare';
import {
  button,
  choose,
  drop,
  fileOf,
  rename,
  rows,
  SESSION,
  saved,
  startTracing,
  stenosis,
} from './controls';
import { Viewer } from './page';
import { NARROWED, openScan, STRAIGHT, traceTube, tubes } from './scans';

const SIZE = { width: 1200, height: 760 };
const SCAN = tubes('tubes.nrrd');
const ROOT = join(import.meta.dirname, '../..');
const PYTHON = process.env.LUMENCUT_PYTHON ?? join(ROOT, '.venv/bin/python');

// Each test continues with the state that the previous one left.
test.describe.configure({ mode: 'serial' });

let viewer: Viewer;
let session: Buffer;
let before: Awaited<ReturnType<typeof pageState>>;
let picture: Awaited<ReturnType<Viewer['pixels']>>;
let stage: string | null;

const started = (browser: Browser, query = '?device=cpu') => Viewer.open(browser, query, { viewport: SIZE });
const fileNow = (bytes = session) => fileOf('lumencut-session.mrk.json', bytes);

const blur = () => viewer.page.getByRole('region', { name: 'Blur of the scan' });

async function pageState() {
  const { page } = viewer;
  const all = (selector: string, property: 'value' | 'checked' | 'textContent' | 'ariaPressed') =>
    page
      .locator(`aside .vessel-rows ${selector}`)
      .evaluateAll(
        (found, name) => found.map((one) => (one as unknown as Record<string, unknown>)[name]),
        property,
      );
  return {
    names: await all('input.name', 'value'),
    colours: await all('select.swatch', 'value'),
    lengths: await all('.length', 'textContent'),
    shown: await all('button.eye', 'ariaPressed'),
    picked: await all('input[type=radio]', 'checked'),
    stenosis: await stenosis(viewer).textContent(),
    places: await page.locator('.place-row > span').allTextContents(),
    rulers: await page.getByTestId('ruler').allTextContents(),
    section: await page.getByTestId('section-numbers').textContent(),
    window: await viewer.window.textContent(),
    readOut: await viewer.readOut.textContent(),
    blur: await blur().textContent(),
    layout: await page.locator('main').getAttribute('data-layout'),
    method: await viewer.field('Method').inputValue(),
    context: await viewer.field('Context').inputValue(),
  };
}

/** Traces both tubes, edits the list, measures, draws a ruler and turns the view. */
async function work(): Promise<void> {
  await startTracing(viewer);
  for (const [n, x] of [NARROWED, STRAIGHT].entries()) {
    await traceTube(viewer, x, [20, -20], n + 1);
    await button(viewer, 'End this vessel').click();
  }
  await button(viewer, 'Done').click();
  await rename(viewer, 0, 'narrowed “A” – ä');
  await viewer.page.getByLabel(/^Colour of narrowed/).selectOption({ index: 5 });
  await rows(viewer).nth(0).getByRole('radio').check();
  await button(viewer, 'Hide Vessel 2').click();
  await viewer.press('2');
  await viewer.research(() => viewer.field('Context').selectOption('dvr'));
  await viewer.press('m');
  await blur().getByLabel('Known FWHM').fill('0.8');
  await blur().getByLabel('Known FWHM').press('Enter');
  await expect(blur()).toContainText('0.80 mm, given');
  await button(viewer, 'Confirm the suggested places').click();
  await expect(stenosis(viewer)).toContainText('%');
  await button(viewer, 'Ruler').click();
  await expect(button(viewer, 'Ruler')).toHaveAttribute('aria-pressed', 'true');
  await viewer.click([0.4, 0.5], 'section');
  await viewer.click([0.6, 0.4], 'section');
  await expect(viewer.page.getByTestId('ruler')).toHaveCount(1);
  await viewer.drag([0.3, 0.4], [60, 25]);
  await viewer.rest();
}

async function expectAllBack(): Promise<void> {
  await expect(rows(viewer)).toHaveCount(2);
  await expect(stenosis(viewer)).toHaveText(before.stenosis ?? '');
  await viewer.rest();
  await expect.poll(pageState).toEqual(before);
  const again = await viewer.picture();
  const tolerances = (await viewer.stage()) === stage ? OTHER_DEVICE : OTHER_SAMPLES;
  expect(difference(again, picture, tolerances)).toBeNull();
  const written = await saved(viewer, SESSION);
  expect(JSON.parse(written.toString('utf-8'))).toEqual(JSON.parse(session.toString('utf-8')));
  expect(written.equals(session)).toBe(true);
}

test.beforeAll(async ({ browser }) => {
  viewer = await started(browser);
  await openScan(viewer, SCAN);
  await work();
  picture = await viewer.picture();
  stage = await viewer.stage();
  session = await saved(viewer, SESSION);
  before = await pageState();
  await viewer.screenshot('session-saved');
});
test.afterEach(() => viewer.expectNoFault());
test.afterAll(() => viewer.close());

test('a reloaded page has kept nothing', async () => {
  await viewer.page.reload();
  await expect(viewer.page.getByRole('heading', { name: 'Lumencut' })).toBeVisible();
  const kept = await viewer.page.evaluate(async () => [
    localStorage.length,
    sessionStorage.length,
    (await indexedDB.databases()).length,
    (await caches.keys()).length,
    document.cookie.length,
  ]);
  expect(kept).toEqual([0, 0, 0, 0, 0]);
  await openScan(viewer, SCAN);
  await expect(viewer.page.getByText('No vessels yet: find all')).toBeVisible();
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(0);
  await expect(button(viewer, 'Undo')).toBeDisabled();
});

test('opened after its scan, the session restores everything, and is saved again with the same bytes', async () => {
  await choose(viewer, fileNow());
  await expectAllBack();
  await viewer.screenshot('session-back');
  await expect(button(viewer, 'Undo')).toBeDisabled();
});

test('clicked points can still be dragged', async () => {
  await viewer.press('t');
  const point = viewer.pane('coronal').getByRole('button', { name: /^Point 2 of narrowed/ });
  const box = await point.boundingBox();
  const length = () => rows(viewer).nth(0).locator('.length').textContent();
  const whole = await length();
  const { mouse } = viewer.page;
  await mouse.move((box?.x ?? 0) + 6, (box?.y ?? 0) + 6);
  await mouse.down();
  await mouse.move((box?.x ?? 0) + 6, (box?.y ?? 0) - 40, { steps: 4 });
  await mouse.up();
  await expect(button(viewer, 'Undo')).toHaveAttribute('title', /move a point/);
  await expect.poll(length).not.toBe(whole);
  await viewer.press('Control+z', 'Escape');
  await expect.poll(length).toBe(whole);
});

test('dropped together with its scan, the session restores everything', async ({ browser }) => {
  await viewer.close();
  viewer = await started(browser);
  await expect(button(viewer, 'Choose files')).toBeEnabled();
  await drop(viewer, fileNow(), SCAN);
  await viewer.rest();
  await viewer.press('v');
  await expectAllBack();
});

test('a session of another scan is rejected with an explanation, and nothing changes', async () => {
  await choose(viewer, tubes('later.nrrd', 5), fileNow());
  await expect(viewer.problem).toContainText(
    /Found a session of a scan of 80 × 56 × 90 voxels in another place; expected a session of the open scan\./,
  );
  await expect(viewer.problem).toContainText("Open the session's own scan");
  await viewer.screenshot('session-of-another-scan');
  await expect(rows(viewer)).toHaveCount(0);
  await openInstead();
});

async function openInstead(): Promise<void> {
  await viewer.problem.getByRole('button', { name: 'Close' }).click();
  await choose(viewer, SCAN);
  await button(viewer, 'Open as a new scan').click();
  await viewer.rest();
}

test('a damaged session is rejected with an explanation, and nothing changes', async () => {
  const text = session.toString('utf-8');
  const damaged = [
    text.slice(0, text.length - 400),
    text.replace('"references_mm"', '"reference_mm"'),
    text.replace(/"at_mm": ?\d+(\.\d+)?/, '"at_mm": "far"'),
  ];
  for (const content of damaged) {
    expect(content).not.toBe(text);
    await choose(viewer, fileNow(Buffer.from(content)));
    await expect(viewer.problem).toContainText(/Found .*; expected .*/);
    await expect(viewer.problem).toContainText('lumencut-session.mrk.json');
    await expect(viewer.problem).not.toContainText('undefined');
    await viewer.problem.getByRole('button', { name: 'Close' }).click();
    await expect(rows(viewer)).toHaveCount(0);
  }
});

/** Text of a PNG chunk. It ends by the length of the chunk, since the bytes that follow may be letters. */
function textOf(png: Buffer, keyword: string): string {
  const begin = png.indexOf(`tEXt${keyword}\0`);
  expect(begin).toBeGreaterThan(0);
  const text = begin + 'tEXt'.length;
  return png.toString('latin1', text + keyword.length + 1, text + png.readUInt32BE(begin - 4));
}

test('the command line measures and renders what the session contains', async () => {
  test.skip(!existsSync(PYTHON), 'there is no Python package beside the repository');
  const [scan, made] = ['tubes.nrrd', 'session.mrk.json'].map((name) => test.info().outputPath(name));
  const [table, rendered] = ['numbers.json', 'view.png'].map((name) => test.info().outputPath(name));
  writeFileSync(scan ?? '', SCAN.buffer);
  writeFileSync(made ?? '', session);
  const lumencut = (...words: (string | undefined)[]) =>
    spawnSync(PYTHON, ['-m', 'lumencut', ...words.map(String)], { cwd: ROOT, encoding: 'utf-8' });
  const measured = lumencut('measure', scan, made, '-o', table);
  expect(measured.status, measured.stderr).toBe(0);
  expect(measured.stdout + measured.stderr).toContain(before.stenosis ?? 'a stenosis');
  const drawn = lumencut('render', scan, '--like', made, '-o', rendered);
  expect(drawn.status, drawn.stderr).toBe(0);
  // A picture stores how it was made: the view of the session, with the only visible vessel.
  const recipe = JSON.parse(textOf(readFileSync(rendered ?? ''), 'Lumencut'));
  const { camera } = JSON.parse(session.toString('utf-8')).LumencutSession.view;
  // Compared with a tolerance, since the axes were normalised again.
  for (const name of ['center', 'direction', 'up', 'size', 'pixel_spacing']) {
    const found: number[] = [recipe.camera[name]].flat();
    const expected: number[] = [camera[name]].flat();
    expect(found).toHaveLength(expected.length);
    found.forEach((number, n) => {
      expect(number).toBeCloseTo(expected[n] ?? Number.NaN, 12);
    });
  }
  expect(recipe.vessels).toBe(1);
});
