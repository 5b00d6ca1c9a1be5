/** Two scans next to each other: linked views, a vessel compared in both, and refusals. */
import { readFileSync, statSync, truncateSync, writeFileSync } from 'node:fs';
import {
  type Browser,
  type BrowserContextOptions,
  expect,
  type FrameLocator,
  type Locator,
  test,
} from '@playwright/test';
import type { Pair } from '../src/core/messages';
import { serious } from './accessibility';
import { button, choose, fileOf, type MadeFile, SESSION, saved } from './controls';
import { series } from './dicom';
import { Viewer } from './page';
import { EARLIER, LATER, lineAt, markups, scanAt, type Time } from './two-times';

const VIEWPORT = { width: 1400, height: 860 };

async function opened(
  browser: Browser,
  files: readonly MadeFile[],
  options: BrowserContextOptions = {},
): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?device=cpu&test', { viewport: VIEWPORT, ...options });
  await expect(viewer.page.getByRole('button', { name: 'Choose files' })).toBeEnabled();
  await choose(viewer, ...files);
  await viewer.rest();
  return viewer;
}

const filesAt = (name: string, time: Time): readonly MadeFile[] => [
  scanAt(`${name}.nrrd`, time),
  lineAt(`${name}.mrk.json`, time),
];

const other = (viewer: Viewer): FrameLocator => viewer.page.frameLocator('iframe[title="Other scan"]');

/** Shows the other scan next to the open one, and waits until both are linked. */
async function openOther(viewer: Viewer, files: readonly MadeFile[]): Promise<void> {
  await viewer.field('Layout').selectOption('Two scans …');
  await expect(other(viewer).getByRole('button', { name: 'Choose files' })).toBeEnabled();
  await other(viewer)
    .locator('main input[type=file]')
    .first()
    .setInputFiles([...files]);
  await expect(button(viewer, 'Compare the vessel')).toBeVisible();
  await expect(other(viewer).locator('canvas.picture')).toHaveAttribute('data-last', 'true');
}

async function both(browser: Browser, options: BrowserContextOptions = {}): Promise<Viewer> {
  const viewer = await opened(browser, filesAt('later', LATER), options);
  await openOther(viewer, filesAt('earlier', EARLIER));
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  return viewer;
}

/** Position of the cross-hair from the middle of a turning view (CSS pixels). */
const hairIn = (turning: Locator): Promise<Pair> =>
  turning.evaluate((pane) => {
    const { left, top } = pane.querySelector<HTMLElement>('.hair')?.style ?? { left: '0', top: '0' };
    return [
      Number.parseFloat(left) - pane.clientWidth / 2,
      Number.parseFloat(top) - pane.clientHeight / 2,
    ] as const;
  });

async function awayFrom(viewer: Viewer): Promise<number> {
  const [[x, y], [u, v]] = [await hairIn(viewer.pane()), await hairIn(other(viewer).getByTestId('turning'))];
  return Math.hypot(u - x, v - y);
}

const letterOf = (viewer: Viewer): Locator => other(viewer).getByTestId('turning').locator('.edge.left');
const sentences = (viewer: Viewer): Locator => viewer.page.getByTestId('comparison-sentences').locator('li');
const refusal = (viewer: Viewer): Locator => viewer.page.locator('.comparison-refused');
const arcLength = async (readOut: Locator): Promise<number> =>
  Number(/· ([\d.]+) mm$/.exec((await readOut.textContent()) ?? '')?.[1] ?? Number.NaN);

test('both scans turn together by mouse and keyboard, from either side', async ({ browser }) => {
  const viewer = await both(browser);
  await expect(viewer.page.locator('.scan-names')).toHaveText(
    'Later scan: later.nrrdEarlier scan: earlier.nrrd',
  );
  await viewer.screenshot('two-scans-opened');
  await viewer.drag([0.5, 0.4], [90, 30]);
  await viewer.click([0.45, 0.6]);
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  await viewer.screenshot('two-scans-turned');
  await viewer.look('l', 'A', 'S');
  await expect(letterOf(viewer)).toHaveText('A');
  await other(viewer).getByTestId('turning').press('p');
  await expect(letterOf(viewer)).toHaveText('L');
  await expect(viewer.pane().locator('.edge.left')).toHaveText('L');
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  viewer.expectNoFault();
  await viewer.close();
});

test('unlinked parts are free, and follow again when they are linked', { tag: '@long' }, async ({
  browser,
}) => {
  const viewer = await both(browser);
  await button(viewer, 'Cameras').click();
  await viewer.look('l', 'A', 'S');
  await expect(letterOf(viewer)).toHaveText('R');
  await button(viewer, 'Cameras').click();
  await expect(letterOf(viewer)).toHaveText('A');
  const windowThere = other(viewer).getByTestId('window');
  await viewer.press('3');
  await expect(windowThere).toHaveText((await viewer.window.textContent()) ?? '');
  for (const isLinked of ['true', 'false', 'true']) {
    await button(viewer, 'Link all').click();
    for (const name of ['Cameras', 'Cross-hairs', 'Slices', 'Windows', 'Looks', 'Layouts']) {
      await expect(button(viewer, name)).toHaveAttribute('aria-pressed', isLinked);
    }
  }
  await button(viewer, 'MIP').click();
  await expect(other(viewer).getByRole('button', { name: 'MIP', exact: true })).toHaveAttribute(
    'aria-pressed',
    'true',
  );
  viewer.expectNoFault();
  await viewer.close();
});

test('slices and layouts are the same in both scans while they are linked', async ({ browser }) => {
  const viewer = await both(browser);
  const layoutThere = other(viewer).locator('main.layout');
  const titleThere = other(viewer).locator('.pane.coronal .pane-title');
  await viewer.field('Layout').selectOption('four');
  await expect(layoutThere).not.toHaveAttribute('data-layout', 'four');
  await button(viewer, 'Layouts').click();
  await expect(layoutThere).toHaveAttribute('data-layout', 'four');
  await expect(titleThere).toHaveText('Coronal');
  await viewer.press('x');
  await viewer.pane('axial').press('ArrowRight');
  await expect(titleThere).toHaveText('Coronal, oblique');
  await button(viewer, 'Slices').click();
  await viewer.press('Control+z');
  await expect(viewer.page.locator('.pane.coronal .pane-title')).toHaveText('Coronal');
  await expect(titleThere).toHaveText('Coronal, oblique');
  await button(viewer, 'Slices').click();
  await expect(titleThere).toHaveText('Coronal');
  await viewer.screenshot('two-scans-slices');
  viewer.expectNoFault();
  await viewer.close();
});

test('a session keeps pairs and the order of the scans', async ({ browser }) => {
  const viewer = await both(browser);
  await button(viewer, 'Pair these places').click();
  await viewer.page.getByLabel('Order of the scans').selectOption('later');
  const session = fileOf('kept.mrk.json', await saved(viewer, SESSION));
  await button(viewer, 'Remove 1 pair').click();
  await viewer.page.getByLabel('Order of the scans').selectOption('earlier');
  await choose(viewer, session);
  await expect(button(viewer, 'Remove 1 pair')).toBeVisible();
  await expect(viewer.page.getByLabel('Order of the scans')).toHaveValue('later');
  await viewer.page.reload();
  await expect(viewer.page.getByRole('button', { name: 'Choose files' })).toBeEnabled();
  await choose(viewer, ...filesAt('later', LATER));
  await viewer.rest();
  await choose(viewer, session);
  await expect(viewer.page.getByTestId('told')).toContainText('compares the scan with another one');
  await openOther(viewer, filesAt('earlier', EARLIER));
  await expect(button(viewer, 'Remove 1 pair')).toBeVisible();
  await expect(viewer.page.getByLabel('Order of the scans')).toHaveValue('later');
  viewer.expectNoFault();
  await viewer.close();
});

test('a pair of places moves the other scan, and three on a line are refused', async ({ browser }) => {
  const viewer = await both(browser);
  const there = other(viewer).getByTestId('readout');
  await button(viewer, 'Cross-hairs').click();
  const kept = (await there.textContent()) ?? '';
  await viewer.click([0.45, 0.65]);
  await expect(there).toHaveText(kept);
  await button(viewer, 'Pair these places').click();
  await expect(button(viewer, 'Remove 1 pair')).toBeVisible();
  // The other scan lies so that its cross-hair, which has not moved, is where this one is.
  await button(viewer, 'Cross-hairs').click();
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  expect((await there.textContent())?.split(' · ')[0]).toBe(kept.split(' · ')[0]);
  await button(viewer, 'Pair these places').click();
  await button(viewer, 'Pair these places').click();
  await expect(viewer.problem).toContainText('Found 3 points on a line');
  await viewer.problem.getByRole('button', { name: 'Close' }).click();
  await button(viewer, 'Remove 3 pairs').click();
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  expect((await there.textContent())?.split(' · ')[0]).not.toBe(kept.split(' · ')[0]);
  viewer.expectNoFault();
  await viewer.close();
});

test('the grown stenosis is compared, charted and saved', async ({ browser }) => {
  const viewer = await both(browser);
  await button(viewer, 'Compare the vessel').click();
  const grown = sentences(viewer).filter({ hasText: /^narrower from/ });
  await expect(grown).toHaveCount(1);
  // The stenosis grew by 1.8 mm, and the patient was moved.
  const stated = Number(/difference (-[\d.]+) ±/.exec((await grown.textContent()) ?? '')?.[1]);
  expect(Math.abs(stated + 1.8)).toBeLessThan(0.15);
  await expect(sentences(viewer).last()).toContainText('matched by the shape of the lines');
  const chart = viewer.page.getByRole('slider', { name: /Place on the earlier vessel/ });
  await chart.click({ position: { x: 300, y: 40 } });
  const places = [viewer.readOut, other(viewer).getByTestId('readout')] as const;
  const apart = async () => Math.abs((await arcLength(places[0])) - (await arcLength(places[1])));
  await expect.poll(apart).toBeLessThan(1);
  const before = await arcLength(places[1]);
  await chart.press('Shift+ArrowRight');
  await expect.poll(() => arcLength(places[1])).toBeGreaterThan(before + 8);
  await expect.poll(apart).toBeLessThan(1);
  await viewer.screenshot('two-scans-compared');
  for (const theme of ['dark', 'light'] as const) {
    await viewer.page.emulateMedia({ colorScheme: theme });
    expect(await serious(viewer.page, theme)).toEqual([]);
    await viewer.screenshot(`two-scans-${theme}`);
  }
  const [download] = await Promise.all([
    viewer.page.waitForEvent('download'),
    button(viewer, 'Save comparison').click(),
  ]);
  const report = readFileSync(await download.path(), 'utf-8');
  expect(report).toContain('Narrower from');
  expect(report.match(/data:image\/png;base64/g)).toHaveLength(2);
  expect(report).not.toContain('later.nrrd');
  // If the other scan is the later one, the vessel has become wider.
  await viewer.page.getByLabel('Order of the scans').selectOption('later');
  await expect(sentences(viewer)).toHaveCount(0);
  await button(viewer, 'Compare the vessel').click();
  await expect(sentences(viewer).filter({ hasText: /^wider from/ })).toHaveCount(1);
  viewer.expectNoFault();
  await viewer.close();
});

test('by touch, a tap moves both cross-hairs', { tag: '@long' }, async ({ browser }) => {
  const viewer = await both(browser, { hasTouch: true });
  await viewer.tap([0.5, 0.7]);
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  await viewer.screenshot('two-scans-touch');
  const before = await viewer.hair('turning');
  await other(viewer)
    .getByTestId('turning')
    .tap({ position: { x: 180, y: 120 } });
  await expect.poll(async () => (await viewer.hair('turning'))[1]).not.toBe(before[1]);
  await expect.poll(() => awayFrom(viewer)).toBeLessThan(1.5);
  viewer.expectNoFault();
  await viewer.close();
});

/** A series of a straight rod, which is a vessel without a shape, and its centerline. */
const rod = (name: string, patient: string): readonly MadeFile[] => {
  const heights = Array.from({ length: 24 }, (_, n) => 2 * n);
  const line = heights.map((height) => [8, 8, height]);
  return [
    ...series(heights, 1, { uid: '1.2.3', number: '7', patient }),
    markups(`${name}.mrk.json`, line, 4),
  ];
};

test('two patients are refused with both names, and compared if the reader insists', async ({ browser }) => {
  const viewer = await opened(browser, rod('later', 'A1'));
  await openOther(viewer, rod('earlier', 'B2'));
  await button(viewer, 'Compare the vessel').click();
  await expect(refusal(viewer)).toContainText(
    "found PatientID 'B2' and PatientID 'A1'; expected scans of one",
  );
  await viewer.screenshot('two-scans-refused');
  await button(viewer, 'Compare them anyway').click();
  // A straight vessel has no shape, so the reader pairs a place.
  await expect(refusal(viewer)).toContainText('give a pair of places');
  await button(viewer, 'Pair these places').click();
  await expect(button(viewer, 'Remove 1 pair')).toBeVisible();
  await button(viewer, 'Compare the vessel').click();
  await button(viewer, 'Compare them anyway').click();
  await expect(sentences(viewer).first()).toContainText('the scans are of two patients');
  await expect(sentences(viewer).last()).toContainText('matched by given places');
  const report = async () => {
    const waiting = viewer.page.waitForEvent('download');
    await button(viewer, 'Save comparison').click();
    return readFileSync(await (await waiting).path(), 'utf-8');
  };
  const unnamed = await report();
  expect(unnamed).toContain('the scans are of two patients');
  expect(unnamed).not.toMatch(/PatientID|later scan: later/);
  await viewer.page.getByLabel('include the name of the scan').first().check();
  expect(await report()).toMatch(/two patients: PatientID \S*B2\S* and PatientID \S*A1/);
  viewer.expectNoFault();
  await viewer.close();
});

test('a scan without the vessel is refused, and closing asks about unsaved work', { tag: '@long' }, async ({
  browser,
}) => {
  const viewer = await opened(browser, filesAt('later', LATER), { viewport: { width: 1024, height: 768 } });
  await openOther(viewer, [scanAt('earlier.nrrd', EARLIER)]);
  // Half of a small window has room for one view.
  for (const place of [viewer.page, other(viewer)]) {
    await expect(place.locator('main.layout')).toHaveAttribute('data-layout', 'one');
  }
  await button(viewer, 'Compare the vessel').click();
  await expect(refusal(viewer)).toContainText('found no vessel in earlier.nrrd');
  await other(viewer).getByRole('button', { name: 'Find all vessels' }).first().click();
  await expect(other(viewer).getByRole('button', { name: 'Undo' })).toBeEnabled();
  await button(viewer, 'Compare the vessel').click();
  await expect(sentences(viewer).filter({ hasText: /^narrower from/ })).toHaveCount(1);
  await button(viewer, 'Close other scan').click();
  await expect(other(viewer).getByRole('alertdialog')).toContainText('Discard 1 vessel');
  await other(viewer).getByRole('button', { name: 'Discard' }).click();
  await expect(viewer.page.locator('iframe')).toHaveCount(0);
  await expect(viewer.field('Layout').locator('option', { hasText: 'Two scans' })).toHaveCount(1);
  viewer.expectNoFault();
  await viewer.close();
});

test('a second scan that the memory cannot hold is refused with a remedy; the first one stays', async ({
  browser,
}, info) => {
  const viewer = await opened(browser, filesAt('later', LATER));
  await viewer.field('Layout').selectOption('Two scans …');
  const path = info.outputPath('large.nrrd');
  const head = `NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: 1500 1500 1500\n`;
  writeFileSync(path, `${head}space directions: (1,0,0) (0,1,0) (0,0,1)\nendian: little\nencoding: raw\n\n`);
  // The file has no voxels on the disk, but their size.
  truncateSync(path, statSync(path).size + 2 * 1500 ** 3);
  await other(viewer).locator('main input[type=file]').first().setInputFiles(path);
  const alert = other(viewer).getByRole('alert');
  await expect(alert).toContainText('Found 6750000000 bytes of voxels');
  await expect(alert.getByRole('button', { name: 'Load every second voxel along each axis' })).toBeVisible();
  await viewer.screenshot('two-scans-memory');
  await viewer.look('l', 'A', 'S');
  viewer.expectNoFault();
  await viewer.close();
});

test('a scan next to itself is recognised, and another scan is not', async ({ browser }) => {
  const viewer = await opened(browser, filesAt('later', LATER));
  const same = viewer.page.getByText('Both are the same scan.');
  await openOther(viewer, filesAt('earlier', EARLIER));
  await expect(same).toHaveCount(0);
  await button(viewer, 'Close other scan').click();
  await openOther(viewer, filesAt('copy', LATER));
  await expect(same).toBeVisible();
  await button(viewer, 'Compare the vessel').click();
  await expect(viewer.page.getByText('both profiles are equal in every section')).toBeVisible();
  await viewer.screenshot('same-scan');
  viewer.expectNoFault();
  await viewer.close();
});
