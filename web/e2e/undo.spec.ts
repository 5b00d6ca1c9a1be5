/** Every edit can be undone and redone, and a new study starts empty. */
import { expect, test } from '@playwright/test';
import { button, choose, nameOf, rename, rows, SESSION, saved, startTracing, stenosis } from './controls';
import { Viewer } from './page';
import { NARROWED, openScan, STRAIGHT, traceTube, tubes } from './scans';

const SIZE = { width: 1200, height: 760 };
const SCAN = tubes('tubes.nrrd');
const STEPS = 30;

let viewer: Viewer;
test.beforeEach(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  await openScan(viewer, SCAN);
});
test.afterEach(async () => {
  viewer.expectNoFault();
  await viewer.close();
});

const undoButton = () => button(viewer, 'Undo');
const point = (n: number, name: string) =>
  viewer.pane('coronal').getByRole('button', { name: `Point ${n} of ${name}` });

/** What the user has made, from a session file, without the state of the display. */
async function made(): Promise<string> {
  const text = (await saved(viewer, SESSION)).toString('utf-8');
  const { view, ...session } = JSON.parse(text).LumencutSession;
  expect(view).not.toBeNull();
  return JSON.stringify({ ...JSON.parse(text), LumencutSession: session });
}

/** Performs an edit and waits until it is the last undo step. */
async function step(words: RegExp, edit: () => Promise<unknown>): Promise<void> {
  await edit();
  await expect(undoButton()).toHaveAttribute('title', words);
  await expect(viewer.page.locator('.trace-bar span').filter({ hasText: 'Tracing …' })).toHaveCount(0);
}

async function editVessels(): Promise<number> {
  const { page } = viewer;
  await startTracing(viewer);
  for (const [n, x] of [NARROWED, STRAIGHT].entries()) {
    await traceTube(viewer, x, [18, -18], n + 1);
    await button(viewer, 'End this vessel').click();
  }
  await point(2, 'Vessel 2').focus();
  for (const key of ['ArrowUp', 'ArrowLeft', 'ArrowUp', 'ArrowRight']) {
    await step(/move a point/, () => viewer.press(key));
  }
  await step(/remove a point/, () => point(2, 'Vessel 2').press('Delete'));
  await viewer.press('Control+z');
  await step(/bridge gaps/, () => page.getByLabel('Bridge gaps without lumen').check());
  await step(/leave gaps/, () => page.getByLabel('Bridge gaps without lumen').uncheck());
  await button(viewer, 'Done').click();
  await step(/rename a vessel/, () => rename(viewer, 0, 'narrowed'));
  await step(/colour a vessel/, () => page.getByLabel('Colour of narrowed').selectOption({ index: 4 }));
  await rows(viewer).nth(1).getByRole('radio').click();
  await expect(rows(viewer).nth(1).getByRole('radio')).toBeChecked();
  await step(/cut a vessel/, () => button(viewer, 'Cut here').click());
  await step(/join two vessels/, () => page.getByLabel('Join Vessel 2 with').selectOption({ index: 2 }));
  await step(/hide a vessel/, () => button(viewer, 'Hide Vessel 2').click());
  await step(/show a vessel/, () => button(viewer, 'Show Vessel 2').click());
  await step(/hide a vessel/, () => button(viewer, 'Hide Vessel 2').click());
  await expect(rows(viewer).nth(1).locator('.buttons')).toHaveCount(0);
  await step(/show a vessel/, () => button(viewer, 'Show Vessel 2').click());
  // The vessel is picked once it is displayed.
  await rows(viewer).nth(1).getByRole('radio').click();
  await expect(rows(viewer).nth(1).getByRole('radio')).toBeChecked();
  await step(/delete a vessel/, () => viewer.press('Delete'));
  await viewer.press('Control+z');
  await step(/show a vessel/, async () => undefined);
  await rows(viewer).nth(0).getByRole('radio').click();
  await expect(rows(viewer).nth(0).getByRole('radio')).toBeChecked();
  await step(/delete a vessel/, () => viewer.press('Delete'));
  await viewer.press('Control+z');
  await rows(viewer).nth(1).getByRole('radio').click();
  await expect(rows(viewer).nth(1).getByRole('radio')).toBeChecked();
  await step(/delete a vessel/, () => rows(viewer).nth(1).getByRole('button', { name: 'Delete' }).click());
  return 2 + 4 + 11;
}

async function editMarks(): Promise<number> {
  const numbers = viewer.page.getByTestId('numbers');
  await viewer.press('m');
  await step(/confirm the suggested places/, () => button(viewer, 'Confirm the suggested places').click());
  const place = viewer.page.getByRole('button', { name: /^(narrowest|marked) place.*, in the profile$/ });
  await place.focus();
  for (const key of ['ArrowLeft', 'ArrowRight', 'Shift+ArrowLeft', 'ArrowLeft', 'ArrowRight', 'ArrowLeft']) {
    await step(/move the marked place/, () => viewer.press(key));
  }
  await step(/choose the method/, () => numbers.getByLabel('Method').selectOption('ecst'));
  const original = numbers.getByLabel('Original diameter');
  await step(/enter the original diameter/, () => original.fill('9').then(() => original.press('Enter')));
  await step(/choose the severity group/, () => numbers.getByLabel('Severity group').selectOption('carotid'));
  await step(/stretch/, () => button(viewer, 'Mark a stretch').click());
  await step(/remove the reference/, () => button(viewer, 'Remove the reference after').click());
  await button(viewer, 'Ruler').click();
  await viewer.click([0.4, 0.5], 'section');
  await step(/measure a distance/, () => viewer.click([0.6, 0.4], 'section'));
  await button(viewer, 'Ruler').click();
  await viewer.click([0.4, 0.7], 'section');
  await step(/measure a distance/, () => viewer.click([0.6, 0.7], 'section'));
  await step(/remove a ruler/, () => button(viewer, 'Remove distance 1').click());
  return 1 + 6 + 8;
}

test('more than thirty steps are undone and redone, and the saved file is the same', {
  tag: '@long',
}, async () => {
  await viewer.press('v');
  const first = await made();
  const count = (await editVessels()) + (await editMarks());
  expect(count).toBeGreaterThanOrEqual(STEPS);
  await expect(stenosis(viewer)).toContainText('ECST');
  await viewer.screenshot('undo-last');
  const last = await made();
  expect(last).not.toBe(first);
  for (const [words, other, key, end] of [
    ['Undo', 'Redo', 'Control+z', first],
    ['Redo', 'Undo', 'Control+Shift+Z', last],
  ] as const) {
    await viewer.pane().focus();
    for (let n = 1; n < count; n++) {
      await viewer.press(key);
    }
    await button(viewer, words).click();
    await expect(button(viewer, words)).toBeDisabled();
    await expect(button(viewer, other)).toBeEnabled();
    expect(await made()).toBe(end);
  }
});

test('nothing of a study remains in the next one', async () => {
  const { page } = viewer;
  await startTracing(viewer);
  await traceTube(viewer, NARROWED, [18, -18], 1);
  await page.getByLabel('Bridge gaps without lumen').check();
  await button(viewer, 'Done').click();
  await viewer.press('m');
  await button(viewer, 'Confirm the suggested places').click();
  await button(viewer, 'Ruler').click();
  await viewer.click([0.4, 0.5], 'section');
  await viewer.click([0.6, 0.4], 'section');
  await expect(page.getByTestId('ruler')).toHaveCount(1);
  await viewer.press('Control+z');
  const blur = page.getByRole('region', { name: 'Blur of the scan' });
  await blur.getByLabel('Known FWHM').fill('0.9');
  await blur.getByLabel('Known FWHM').press('Enter');
  await expect(blur).toContainText(', given.');
  await button(viewer, 'Ruler').click();
  await viewer.click([0.4, 0.5], 'section');
  await choose(viewer, tubes('next.nrrd', 5));
  await button(viewer, 'Open as a new scan').click();
  await button(viewer, 'Discard').click();
  await expect(rows(viewer)).toHaveCount(0);
  await viewer.rest();
  for (const words of ['Undo', 'Redo']) {
    await expect(button(viewer, words)).toBeDisabled();
  }
  await expect(page.getByTestId('ruler')).toHaveCount(0);
  await expect(stenosis(viewer)).toHaveCount(0);
  await viewer.screenshot('next-study');
  const session = JSON.parse(await made()).LumencutSession;
  expect(session).toMatchObject({ vessels: [], doubtful: [], stoppers: [], rulers: [], bridge: false });
  // The next scan is measured without marks and with its own estimate of the FWHM.
  await startTracing(viewer);
  await expect(page.locator('[data-place]')).toHaveCount(0);
  await traceTube(viewer, NARROWED, [18, -18], 1);
  await expect(nameOf(viewer, 0)).toHaveValue('Vessel 1');
  await viewer.press('m');
  await expect(stenosis(viewer)).toContainText('Nothing is marked');
  await expect(blur).toContainText('estimated on');
  await expect(button(viewer, 'Ruler')).toHaveAttribute('aria-pressed', 'false');
});
