/** The line of a vessel is moved and smoothed by hand: sections, list, tables and sessions say so. */
import { type Browser, type BrowserContextOptions, expect, type Locator, test } from '@playwright/test';
import { button, choose, fileOf, rows, SESSION, saved } from './controls';
import { Viewer } from './page';

const SIZE = { width: 1280, height: 800 };

async function opened(browser: Browser, options: BrowserContextOptions = {}): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu&test', {
    viewport: SIZE,
    ...options,
  });
  await viewer.rest();
  await viewer.field('Layout').selectOption('four');
  await viewer.press('v');
  await expect(rows(viewer)).toHaveCount(1);
  return viewer;
}

const edit = (viewer: Viewer): Locator => button(viewer, 'Edit line');
const grip = (viewer: Viewer, pane: 'coronal' | 'section', n = 1): Locator =>
  viewer.pane(pane).getByRole('button', { name: `Grip ${n} of the line` });
const byHand = (viewer: Viewer): Locator => rows(viewer).first().getByText('line by hand');

async function pull(viewer: Viewer, of: Locator, [dx, dy]: readonly [number, number]): Promise<void> {
  const box = await of.boundingBox();
  if (!box) {
    throw new Error('the grip is not shown');
  }
  const { mouse } = viewer.page;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await mouse.move(x, y);
  await mouse.down();
  await mouse.move(x + dx, y + dy, { steps: 4 });
}

/** Largest distance of the points of the picked line from those that it had at first (mm). */
async function moved(viewer: Viewer): Promise<number> {
  const { vessels } = await viewer.report();
  const [first, now] = await Promise.all(
    [0, vessels?.[0]?.line ?? 0].map((line) => viewer.ask('line', { line })),
  );
  const apart = (n: number) => {
    const [a, b] = [first?.points[n] ?? [0, 0, 0], now?.points[n] ?? [0, 0, 0]];
    return Math.hypot(...a.map((part, axis) => part - (b[axis] ?? 0)));
  };
  return Math.max(...(now?.points ?? []).map((_, n) => apart(n)));
}

test('a drag at a grip moves the line, the list says so, and undo brings it back', async ({ browser }) => {
  const viewer = await opened(browser);
  await edit(viewer).click();
  await expect(grip(viewer, 'coronal', 3)).toBeVisible();
  await pull(viewer, grip(viewer, 'coronal', 3), [16, 0]);
  await expect(viewer.pane('coronal').locator('path.live')).toHaveCount(1);
  await viewer.screenshot('line-by-hand');
  await viewer.page.mouse.up();
  await expect(byHand(viewer)).toBeVisible();
  await expect.poll(() => moved(viewer)).toBeGreaterThan(0.5);
  await expect(viewer.page.getByRole('button', { name: 'Undo' })).toHaveAttribute('title', /move a line/);
  await viewer.press('Control+z');
  await expect(byHand(viewer)).toHaveCount(0);
  await expect.poll(() => moved(viewer)).toBe(0);
  await viewer.press('Control+Shift+Z');
  await expect(byHand(viewer)).toBeVisible();
  viewer.expectNoFault();
  await viewer.close();
});

test('a grip in the straightened vessel moves the line sideways in its picture', async ({ browser }) => {
  const viewer = await opened(browser);
  await viewer.field('Layout').selectOption('strip');
  await edit(viewer).click();
  const middle = viewer.pane('straightened').getByRole('button', { name: 'Grip 3 of the line' });
  await pull(viewer, middle, [10, 0]);
  await viewer.screenshot('line-by-hand-straightened');
  await viewer.page.mouse.up();
  await expect(byHand(viewer)).toBeVisible();
  await expect.poll(() => moved(viewer)).toBeGreaterThan(0.5);
  await viewer.press('Control+z');
  await middle.focus();
  await viewer.press('Shift+ArrowRight');
  await expect(byHand(viewer)).toBeVisible();
  viewer.expectNoFault();
  await viewer.close();
});

test('Escape ends a drag without a change, and then the grips', async ({ browser }) => {
  const viewer = await opened(browser);
  await edit(viewer).click();
  await pull(viewer, grip(viewer, 'coronal', 3), [20, 0]);
  await expect(viewer.pane('coronal').locator('path.live')).toHaveCount(1);
  await viewer.press('Escape');
  await expect(viewer.pane('coronal').locator('path.live')).toHaveCount(0);
  await viewer.page.mouse.up();
  await viewer.press('Escape');
  await expect(grip(viewer, 'coronal')).toHaveCount(0);
  await expect(byHand(viewer)).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});

test('a pull in the section is measured again, and numbers, tables and session say that the line is by hand', async ({
  browser,
}) => {
  const viewer = await opened(browser);
  const numbers = viewer.page.getByTestId('section-numbers');
  await viewer.press('m');
  await expect(numbers).toContainText('diameter');
  await button(viewer, 'Edit contour').click();
  await pull(viewer, viewer.pane('section').getByRole('button', { name: 'Grip 1 of the contour' }), [9, 0]);
  await viewer.page.mouse.up();
  await expect(numbers).toContainText('contour by hand');
  await button(viewer, 'Edit contour').click();
  await edit(viewer).click();
  await pull(viewer, grip(viewer, 'section'), [14, 0]);
  await viewer.page.mouse.up();
  await expect(viewer.page.getByText(/^The contours by hand of tube lay on its old line/)).toBeVisible();
  await expect(byHand(viewer)).toBeVisible();
  await expect(numbers).toContainText('line by hand');
  await viewer.rest();
  await viewer.screenshot('line-by-hand-section');
  for (const kind of ['CSV', 'JSON']) {
    const table = await saved(viewer, `Measurements of all measured vessels (${kind})`);
    expect(table.toString('utf-8'), kind).toContain('line by hand');
  }
  const session = await saved(viewer, SESSION);
  const content = JSON.parse(session.toString('utf-8')).LumencutSession;
  expect(content.format).toBe(2);
  expect(content.vessels[0].by_hand).toContain(true);
  await choose(viewer, fileOf('saved.mrk.json', session));
  await expect(byHand(viewer)).toBeVisible();
  await expect(numbers).toContainText('line by hand');
  viewer.expectNoFault();
  await viewer.close();
});

test('keys move a grip, and the slider smooths what they bent, with a preview', async ({ browser }) => {
  const viewer = await opened(browser);
  await edit(viewer).focus();
  await viewer.press('Enter');
  await grip(viewer, 'coronal', 3).focus();
  await viewer.press('Shift+ArrowRight');
  await expect(byHand(viewer)).toBeVisible();
  const bent = await moved(viewer);
  expect(bent).toBeGreaterThan(1);
  await expect(grip(viewer, 'coronal', 3)).toBeFocused();
  const slider = viewer.page.getByLabel('Smooth', { exact: false }).and(viewer.page.locator('[type=range]'));
  await slider.focus();
  await viewer.press(...Array<string>(20).fill('ArrowRight'));
  await expect.poll(() => moved(viewer)).toBeLessThan(bent);
  await expect(viewer.page.getByRole('button', { name: 'Undo' })).toHaveAttribute('title', /smooth a line/);
  viewer.expectNoFault();
  await viewer.close();
});

test('a finger moves a grip', async ({ browser }) => {
  const viewer = await opened(browser, { hasTouch: true });
  await edit(viewer).tap();
  const box = await grip(viewer, 'coronal', 3).boundingBox();
  const client = await viewer.page.context().newCDPSession(viewer.page);
  const [x, y] = [(box?.x ?? 0) + 6, (box?.y ?? 0) + 6];
  await client.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y }] });
  for (const by of [4, 10, 18]) {
    await client.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [{ x: x + by, y }] });
  }
  await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await expect(byHand(viewer)).toBeVisible();
  viewer.expectNoFault();
  await viewer.close();
});
