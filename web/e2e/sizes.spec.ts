/** Tests of window sizes, high-resolution screens, touch, accessibility and keyboard use. */
import { type CDPSession, expect, test } from '@playwright/test';
import type { Pair } from '../src/core/messages';
import { length, subtract } from '../src/core/vectors';
import { serious } from './accessibility';
import { isEmpty } from './compare';
import { Viewer } from './page';

const SMALL = { width: 360, height: 640 };
const LARGE = { width: 1920, height: 1080 };

for (const [name, viewport] of [
  ['small', SMALL],
  ['large', LARGE],
] as const) {
  test(`a ${name} window shows everything without a scroll bar`, async ({ browser }) => {
    const viewer = await Viewer.open(browser, '?device=cpu', { viewport });
    await expect(viewer.page.getByRole('button', { name: 'Aorta' })).toBeEnabled();
    await viewer.screenshot(`${name}-start`);
    await viewer.page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
    await viewer.rest();
    await viewer.screenshot(name);
    const page = await viewer.page.evaluate(() => [
      document.documentElement.scrollWidth,
      document.documentElement.scrollHeight,
    ]);
    expect(page).toEqual([viewport.width, viewport.height]);
    const [width, height] = await viewer.size();
    expect(width * height).toBeGreaterThan(0.25 * viewport.width * viewport.height);
    expect(isEmpty(await viewer.pixels())).toBe(false);
    await expect(viewer.field('Layout')).toBeInViewport({ ratio: 1 });
    for (const words of ['Research', 'Save']) {
      await expect(viewer.page.getByText(words, { exact: true })).toBeInViewport({ ratio: 1 });
    }
    await expect(viewer.page.getByLabel('Window preset')).toBeInViewport({ ratio: 1 });
    viewer.expectNoFault();
    await viewer.close();
  });
}

test('at 200 % the view has as many pixels as the screen, and a click picks the right point', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu', {
    deviceScaleFactor: 2,
    viewport: { width: 640, height: 480 },
  });
  await viewer.rest();
  const [width, height] = await viewer.size();
  const pixels = await viewer.pixels();
  expect([pixels.width, pixels.height]).toEqual([2 * width, 2 * height]);
  await viewer.click([0.5, 0.7]);
  await expect(viewer.readOut).toHaveText(/ · trunk · /);
  expect(await viewer.size()).toEqual([width, height]);
  const [x, y] = await viewer.hair('turning');
  expect(Math.abs(x - 0.5 * width)).toBeLessThan(2);
  expect(Math.abs(y - 0.7 * height)).toBeLessThan(2);
  await viewer.screenshot('dense');
  viewer.expectNoFault();
  await viewer.close();
});

test.describe('touch', () => {
  type Kind = 'touchStart' | 'touchMove' | 'touchEnd';
  const send = (client: CDPSession, type: Kind, points: readonly Pair[]) =>
    client.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: points.map(([x, y], id) => ({ x, y, id })),
    });

  test('one finger rotates, two pinch, and a tablet has the toolbar in one row', async ({ browser }) => {
    const viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu', {
      hasTouch: true,
      viewport: { width: 640, height: 480 },
    });
    await viewer.rest();
    const client = await viewer.page.context().newCDPSession(viewer.page);
    const [x, y] = await viewer.place([0.5, 0.5]);
    const before = await viewer.camera();
    await send(client, 'touchStart', [[x, y]]);
    for (const step of [10, 25, 40]) {
      await send(client, 'touchMove', [[x + step, y + step / 2]]);
    }
    await send(client, 'touchEnd', []);
    const turned = await viewer.camera();
    expect(length(subtract(turned.direction, before.direction))).toBeGreaterThan(0.05);
    expect(turned.pixel_spacing).toBeCloseTo(before.pixel_spacing, 9);
    await send(client, 'touchStart', [[x - 30, y]]);
    await send(client, 'touchStart', [
      [x - 30, y],
      [x + 30, y],
    ]);
    for (const step of [40, 50, 60]) {
      await send(client, 'touchMove', [
        [x - step, y],
        [x + step, y],
      ]);
    }
    await send(client, 'touchEnd', []);
    const zoomed = await viewer.camera();
    expect(zoomed.pixel_spacing).toBeCloseTo(turned.pixel_spacing / 2, 2);
    expect(zoomed.direction).toEqual(turned.direction);
    await viewer.page.setViewportSize({ width: 1024, height: 768 });
    expect((await viewer.page.locator('header.toolbar').boundingBox())?.height).toBeLessThan(60);
    await expect(viewer.page.getByRole('button', { name: 'Close the scan' })).toBeInViewport({ ratio: 1 });
    await viewer.press('v', 'm');
    await expect(viewer.pane('section')).toBeVisible();
    const section = await viewer.box('section');
    expect(section.width, 'beside the list').toBeGreaterThanOrEqual(220);
    const divider = await viewer.page
      .getByRole('separator', { name: 'Width of the left views' })
      .boundingBox();
    expect(Math.abs((divider?.x ?? 0) - section.x)).toBeLessThan(6);
    viewer.expectNoFault();
    await viewer.close();
  });
});

/** Serious faults that axe finds in a theme. In the light one it judges contrast alone, since the rest is the same. */
test('axe finds no serious fault at the start, in an open scan and in the help, in both themes', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?device=cpu');
  const { page } = viewer;
  const expectNone = async (name: string) => {
    for (const colorScheme of ['dark', 'light'] as const) {
      await page.emulateMedia({ colorScheme });
      await viewer.screenshot(`${name}-${colorScheme}`);
      expect(await serious(page, colorScheme), `${name} in the ${colorScheme} theme`).toEqual([]);
    }
  };
  await expect(page.getByRole('button', { name: 'Aorta' })).toBeEnabled();
  await expectNone('start');
  await page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
  await viewer.rest();
  await expectNone('open');
  await viewer.press('?');
  await expect(page.getByRole('dialog')).toBeVisible();
  await expectNone('help');
  viewer.expectNoFault();
  await viewer.close();
});

test('every control is reached by the keyboard, and the toolbar is one row in windows of usual sizes', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu');
  await viewer.rest();
  const reached = new Set<string>();
  for (let n = 0; n < 40; n++) {
    await viewer.press('Tab');
    const name = await viewer.page.evaluate(() => {
      const element = document.activeElement;
      return (
        element?.getAttribute('aria-label') ?? element?.closest('label')?.textContent ?? element?.textContent
      );
    });
    reached.add((name ?? '').slice(0, 9));
  }
  for (const name of [
    '✎ Trace',
    'Lumen',
    'Lumen in ',
    'LinesNo l',
    'Window pr',
    'LayoutOne',
    'Research',
    'Save',
  ]) {
    expect(reached).toContain(name);
  }
  expect(reached).toContain('vessels, ');
  for (const width of [1024, 1280, 1440, 1920]) {
    await viewer.page.setViewportSize({ width, height: 768 });
    const bar = await viewer.page.locator('.toolbar').boundingBox();
    expect(bar?.height, `at ${width}`).toBeLessThan(60);
  }
  await viewer.page.setViewportSize({ width: 720, height: 450 });
  const views = await viewer.page.locator('main').boundingBox();
  expect(views?.height, 'at 200 % zoom').toBeGreaterThan(0.8 * 450);
  viewer.expectNoFault();
  await viewer.close();
});

/** Usual window sizes: a screen; then, judged only by the long tests, a tablet with touch, larger screens and 200 % zoom. */
const USUAL = [
  { tag: [], viewports: [{ width: 1280, height: 720 }] },
  { tag: '@long', hasTouch: true, viewports: [{ width: 1024, height: 768 }] },
  {
    tag: '@long',
    viewports: [
      { width: 1440, height: 900 },
      { width: 1920, height: 1080 },
    ],
  },
  { tag: '@long', deviceScaleFactor: 2, viewports: [{ width: 720, height: 450 }] },
];

const MODES = [
  ['look', 'v'],
  ['trace', 't'],
  ['measure', 'm'],
  ['report', 'e'],
] as const;

for (const { tag, viewports, ...screen } of USUAL) {
  const name = viewports.map(({ width, height }) => `${width} × ${height}`).join(', ');
  test(`axe finds no serious fault in any mode at ${name}, in both themes`, { tag }, async ({ browser }) => {
    const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu', {
      ...screen,
      viewport: viewports[0] ?? LARGE,
    });
    const { page } = viewer;
    await viewer.rest();
    for (const [mode, key] of MODES) {
      await viewer.press(key);
      if (mode === 'measure') {
        await expect(page.locator('.place-row').first()).toBeVisible();
      }
      for (const viewport of viewports) {
        await page.setViewportSize(viewport);
        const themes = viewport === viewports.at(-1) ? (['dark', 'light'] as const) : (['dark'] as const);
        for (const colorScheme of themes) {
          await page.emulateMedia({ colorScheme });
          await viewer.frames();
          await viewer.screenshot(`${mode}-${viewport.width}-${colorScheme}`);
          expect(await serious(page, colorScheme), `${mode} at ${viewport.width}`).toEqual([]);
        }
      }
    }
    viewer.expectNoFault();
    await viewer.close();
  });
}
