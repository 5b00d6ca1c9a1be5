/** "Save for PACS" saves an archive of DICOM objects from the server of the page; Python can read them. */
import { type ChildProcess, spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { createInterface, type Interface } from 'node:readline';
import { type Browser, expect, test } from '@playwright/test';
import { button, menu, nameOf, rows, SIZE } from './controls';
import { Viewer } from './page';

const ROOT = join(import.meta.dirname, '../..');
const python = process.env.LUMENCUT_PYTHON ?? join(ROOT, '.venv/bin/python');
const SCRIPT = join(ROOT, 'tests/pacs_page.py');
const ENVIRONMENT = { ...process.env, PYTHONPATH: join(ROOT, 'python') };

interface Served {
  readonly address: string;
  readonly files: readonly string[];
  readonly lines: string;
  readonly segmentation: string;
  readonly contours: string;
  readonly other: string;
}

interface Told {
  readonly errors: readonly string[];
  readonly patient: string;
  readonly description: string;
  readonly sources: number;
  readonly findings?: readonly string[];
  readonly names?: readonly string[];
  readonly diameters?: readonly number[];
  readonly words?: readonly string[];
}

interface Server extends Served {
  /** What Python reads in an archive. */
  readonly read: (archive: string) => Promise<Record<string, Told>>;
}

/** The servers that the tests share: one without, one with a scan. */
const running = new Map<string, { readonly process: ChildProcess; readonly server: Promise<Server> }>();
test.afterAll(() => {
  for (const { process } of running.values()) {
    process.stdin?.end();
  }
  running.clear();
});

function served(...words: readonly string[]): Promise<Server> {
  const known = running.get(words.join());
  if (known) {
    return known.server;
  }
  const started = spawn(python, [SCRIPT, join(ROOT, 'web/dist'), ...words], {
    env: ENVIRONMENT,
    stdio: ['pipe', 'pipe', 'inherit'],
  });
  const lines = createInterface(started.stdout);
  const server = told<Served>(lines).then((place) => ({
    ...place,
    read: (archive: string) => {
      started.stdin.write(`${archive}\n`);
      return told<Record<string, Told>>(lines);
    },
  }));
  running.set(words.join(), { process: started, server });
  return server;
}

async function told<T>(lines: Interface): Promise<T> {
  const [line] = await once(lines, 'line');
  return JSON.parse(line);
}

const opened = (browser: Browser, { address }: Served): Promise<Viewer> =>
  Viewer.open(browser, '?device=cpu', { baseURL: address, viewport: SIZE });

async function measured(viewer: Viewer): Promise<void> {
  await viewer.rest();
  await viewer.press('m');
  await button(viewer, 'Confirm the suggested places').click();
  await expect(viewer.page.getByTestId('stenosis')).toContainText('NASCET');
}

/** Saves by the menu, and answers the question about the study. Returns the content of the archive. */
async function saved(viewer: Viewer, answer: string, { read }: Server): Promise<Record<string, Told>> {
  await menu(viewer).click();
  await button(viewer, 'For PACS (DICOM, zip)').click();
  const [download] = await Promise.all([
    viewer.page.waitForEvent('download'),
    button(viewer, answer).click(),
  ]);
  await expect(viewer.page.getByTestId('told')).toContainText('Nothing was sent');
  expect(download.suggestedFilename()).toMatch(/-pacs-.*\.zip$/);
  return read(await download.path());
}

const ALL = ['finding-1.dcm', 'report-pdf.dcm', 'report.dcm', 'vessel.dcm', 'view.dcm'];

test('from a DICOM folder to an archive of objects in the study of the scan', async ({ browser }) => {
  const place = await served();
  const viewer = await opened(browser, place);
  await expect(button(viewer, 'Choose files')).toBeEnabled();
  await viewer.page
    .locator('main input[type=file]')
    .first()
    .setInputFiles([...place.files, place.lines]);
  await measured(viewer);
  const shown = await viewer.page.locator('[data-testid=stenosis] .graded').innerText();
  const found = await saved(viewer, 'Save in the study of the scan', place);
  expect(Object.keys(found).sort()).toEqual(ALL);
  for (const told of Object.values(found)) {
    expect(told.errors).toEqual([]);
    expect(told.patient).toBe('Doe^Jane');
    expect(told.description).toContain('(research, not for diagnosis)');
  }
  expect(found['view.dcm']?.sources).toBe(place.files.length);
  expect(found['report.dcm']?.findings).toContain('Site of Lumen Minimum');
  expect(found['report.dcm']?.findings).toContain('stenosis');
  // DICOM text has no sign for plus or minus.
  expect(found['report.dcm']?.words?.join('\n')).toContain(shown.replaceAll('±', '+/-'));
  expect(found['report.dcm']?.names?.join()).toContain('left renal artery');
  viewer.expectNoFault();
  await viewer.close();
});

test('a scan opened by the server, saved anonymously and in its study: the same numbers, and no name', async ({
  browser,
}) => {
  const place = await served('scan');
  const viewer = await opened(browser, place);
  await measured(viewer);
  const named = await saved(viewer, 'Save in the study of the scan', place);
  const bare = await saved(viewer, 'Anonymous', place);
  expect(bare['report.dcm']?.diameters).toEqual(named['report.dcm']?.diameters);
  expect(Object.values(bare).map(({ patient }) => patient)).toEqual(ALL.map(() => ''));
  expect(bare['report.dcm']?.names?.join()).not.toContain('renal');
  viewer.expectNoFault();
  await viewer.close();
});

test('a scan that is not DICOM uses the study of a chosen file, and other files are rejected', async ({
  browser,
}) => {
  const place = await served();
  const viewer = await opened(browser, place);
  await viewer.page.goto(`${place.address}?phantom=stenosis&device=cpu`);
  await viewer.rest();
  const ask = async () => {
    await menu(viewer).click();
    await button(viewer, 'For PACS (DICOM, zip)').click();
    await expect(button(viewer, 'Save in the study of the scan')).toHaveCount(0);
  };
  await ask();
  await viewer.page.getByLabel('DICOM file of the study').setInputFiles(place.lines);
  await expect(viewer.problem).toContainText('no DICOM');
  await ask();
  await viewer.page.getByLabel('DICOM file of the study').setInputFiles(place.files[3] ?? '');
  const question = viewer.page.getByRole('alertdialog', { name: 'Study of the chosen file' });
  await expect(question.locator('dd')).toHaveText(['Doe^Jane', 'J-17', '20260101', 'CT', 'ABDOMEN']);
  const [download] = await Promise.all([
    viewer.page.waitForEvent('download'),
    button(viewer, 'Save in this study').click(),
  ]);
  const found = await place.read(await download.path());
  expect(Object.keys(found).sort()).toEqual(['vessel.dcm', 'view.dcm']);
  expect(found['view.dcm']?.patient).toBe('Doe^Jane');
  viewer.expectNoFault();
  await viewer.close();
});

test('a file of another patient is shown and rejected, and another one can be chosen', async ({
  browser,
}) => {
  for (const words of [['scan'], []]) {
    const place = await served(...words);
    const viewer = await opened(browser, place);
    if (words.length === 0) {
      await expect(button(viewer, 'Choose files')).toBeEnabled();
      await viewer.page
        .locator('main input[type=file]')
        .first()
        .setInputFiles([...place.files, place.lines]);
    }
    await viewer.rest();
    await menu(viewer).click();
    await button(viewer, 'For PACS (DICOM, zip)').click();
    await viewer.page.getByLabel('DICOM file of the study').setInputFiles(place.other);
    const question = viewer.page.getByRole('alertdialog', { name: 'Study of the chosen file' });
    await expect(question).toContainText('This file cannot be used');
    await expect(question).toContainText("'J-17'");
    await expect(question.locator('dd').first()).toHaveText('Roe^Mary');
    await expect(button(viewer, 'Save in this study')).toHaveCount(0);
    await button(viewer, 'Choose again').click();
    await viewer.page.getByLabel('DICOM file of the study').setInputFiles(place.files[2] ?? '');
    await expect(button(viewer, 'Save in this study')).toBeVisible();
    await expect(question.locator('li')).toHaveCount(0);
    viewer.expectNoFault();
    await viewer.close();
  }
});

test('a page from a plain file server says which server it needs', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu', { viewport: SIZE });
  await viewer.rest();
  await menu(viewer).click();
  await button(viewer, 'For PACS (DICOM, zip)').click();
  await expect(viewer.problem).toContainText('Open the scan with `lumencut view`');
  viewer.expectNoFault();
  await viewer.close();
});

test('a segmentation is used as a vessel mask, and contours are rejected with an explanation', async ({
  browser,
}) => {
  const place = await served('scan');
  const viewer = await opened(browser, place);
  await viewer.rest();
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(1);
  const input = viewer.page.locator('header input[type=file]').first();
  await input.setInputFiles(place.contours);
  await expect(viewer.problem).toContainText('RT Structure Set');
  await expect(viewer.problem).toContainText('onvert its contours to a DICOM segmentation');
  await input.setInputFiles(place.segmentation);
  await expect(rows(viewer)).toHaveCount(2);
  await expect(nameOf(viewer, 1)).toHaveValue('left renal artery');
  await viewer.rest();
  expect(viewer.faults).toEqual([expect.stringContaining('422')]);
  await viewer.close();
});

test('a scan of the server is compared with files of the same patient in a frame of its page', async ({
  browser,
}) => {
  const place = await served('scan');
  const viewer = await opened(browser, place);
  await viewer.rest();
  await viewer.field('Layout').selectOption('Two scans …');
  const other = viewer.page.frameLocator('iframe[title="Other scan"]');
  // The frame begins without the scan of the server.
  await expect(other.getByRole('heading', { name: 'Other scan' })).toBeVisible();
  await other
    .locator('main input[type=file]')
    .first()
    .setInputFiles([...place.files, place.lines]);
  await button(viewer, 'Pair these places').click();
  await button(viewer, 'Compare the vessel').click();
  const sentences = viewer.page.getByTestId('comparison-sentences');
  await expect(sentences).toContainText('no change beyond 2 standard deviations');
  await expect(sentences).not.toContainText('patient');
  viewer.expectNoFault();
  await viewer.close();
});
