/** The contour of a section is drawn by hand at its grips: the numbers follow, and every output says so. */
import { expect, type Locator, test } from '@playwright/test';
import { choose, fileOf, REPORT, SESSION } from './controls';
import { MeasuredTube } from './measured-tube';

const TABLES = ['CSV', 'JSON'].map((kind) => `Measurements of all measured vessels (${kind})`);

let tube: MeasuredTube;
test.beforeAll(async ({ browser }) => {
  tube = await MeasuredTube.open(browser);
});
test.afterEach(() => tube.viewer.expectNoFault());

const numbers = () => tube.viewer.page.getByTestId('section-numbers');
const grip = (n: number): Locator =>
  tube.viewer.pane('section').getByRole('button', { name: `Grip ${n} of the contour` });
const edit = () => tube.button('Edit contour');
const drawing = () =>
  tube.viewer
    .pane('section')
    .locator('.section-marks path')
    .first()
    .evaluate((path) => [path.getAttribute('stroke'), path.getAttribute('stroke-dasharray')]);
const undoTitle = () => tube.viewer.page.getByRole('button', { name: 'Undo' });

async function area(): Promise<number> {
  return Number(/area ([\d.]+)/.exec((await numbers().textContent()) ?? '')?.[1]);
}

/** Moves the section to the marked or suggested stenosis. */
const showPlace = () => tube.row('place-0').getByRole('button').first().click();

async function automatic(): Promise<void> {
  if ((await edit().getAttribute('aria-pressed')) === 'true') {
    await edit().click();
  }
  const back = tube.button('Automatic');
  // The button appears once the edited section is drawn.
  await expect(async () => {
    if ((await back.count()) > 0) {
      await back.click();
    }
    await expect(numbers()).not.toContainText('by hand', { timeout: 1000 });
  }).toPass();
}

test('a drag at a grip pulls the contour, the numbers follow, and undo brings the automatic one back', async () => {
  await automatic();
  await expect(grip(1)).toHaveCount(0);
  await tube.marked();
  await showPlace();
  const before = await area();
  await expect(tube.stenosis()).toContainText('%');
  const percent = await tube.stenosis().textContent();
  const plain = await drawing();
  expect(plain).toEqual(['#00e5ff', null]);
  await edit().click();
  await expect(grip(16)).toBeVisible();
  await tube.dragBy(grip(1), [24, 0]);
  await expect(numbers()).toContainText('by hand');
  await expect(numbers()).toContainText('contour by hand');
  await expect.poll(drawing).toEqual(['#b4ff39', '9 4']);
  await tube.viewer.screenshot('contour-by-hand');
  const after = await area();
  expect(after).toBeGreaterThan(before * 1.05);
  await expect(undoTitle()).toHaveAttribute('title', /draw a contour/);
  await expect(tube.stenosis()).not.toHaveText(percent ?? '');
  await tube.viewer.press('Control+z');
  await expect(numbers()).not.toContainText('by hand');
  expect(await area()).toBe(before);
  await expect.poll(drawing).toEqual(plain);
  await expect(tube.stenosis()).toHaveText(percent ?? '');
  await tube.viewer.press('Control+Shift+Z');
  await expect(numbers()).toContainText('by hand');
  expect(await area()).toBe(after);
  await automatic();
  expect(await area()).toBe(before);
  await tube.nothingMarked();
});

test('Escape ends a drag without a change, and then the grips', async () => {
  await automatic();
  const before = await area();
  await edit().click();
  const { mouse } = tube.viewer.page;
  const [x, y] = await tube.middleOf(grip(5));
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x, y + 30, { steps: 4 });
  await expect.poll(area).not.toBe(before);
  await tube.viewer.press('Escape');
  await expect.poll(area).toBe(before);
  await mouse.up();
  await expect(numbers()).not.toContainText('by hand');
  await tube.viewer.press('Escape');
  await expect(grip(5)).toHaveCount(0);
});

test('arrow keys move a grip, which keeps the focus', async () => {
  await automatic();
  const before = await area();
  await edit().focus();
  await tube.viewer.press('Enter');
  await grip(1).focus();
  await tube.viewer.press('Shift+ArrowRight');
  await expect(numbers()).toContainText('by hand');
  await expect.poll(area).toBeGreaterThan(before);
  await expect(grip(1)).toBeFocused();
  await automatic();
});

test('report, tables and session say that the contour was drawn by hand, and a session keeps it', async () => {
  await automatic();
  await tube.nothingMarked();
  await showPlace();
  await tube.button('Narrowest here').click();
  await edit().click();
  await tube.dragBy(grip(1), [20, 0]);
  await expect(numbers()).toContainText('by hand');
  const drawn = await area();
  for (const words of [REPORT, ...TABLES]) {
    expect(await tube.saved(words), words).toContain('by hand');
  }
  const session = await tube.saved(SESSION);
  const content = JSON.parse(session).LumencutSession;
  expect([content.format, content.vessels[0].contours_mm.length]).toEqual([2, 1]);
  // Saved work is not asked about, so the session is opened over the same document.
  await choose(tube.viewer, fileOf('saved.mrk.json', Buffer.from(session)));
  await showPlace();
  await expect(numbers()).toContainText('by hand');
  expect(await area()).toBe(drawn);
  await automatic();
  await tube.nothingMarked();
});
