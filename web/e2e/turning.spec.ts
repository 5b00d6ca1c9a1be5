/** Tests of mouse and keys in the turning view. */
import { expect, test } from '@playwright/test';
import { pixelOf } from '../src/core/camera';
import type { Camera, Pair, Vector } from '../src/core/messages';
import { add, cross, length, scale, subtract } from '../src/core/vectors';
import { BINDINGS } from '../src/input/bindings';
import { difference, isEmpty, type Pixels, SAME_CODE } from './compare';
import { Viewer } from './page';

let viewer: Viewer;

test.beforeAll(async ({ browser }) => {
  viewer = await Viewer.open(browser, '?phantom=y_junction&device=cpu');
  await viewer.rest();
});
test.afterEach(() => viewer.expectNoFault());
test.afterAll(() => viewer.close());

function pointAt(camera: Camera, [x, y]: Pair): Vector {
  const [mx, my] = [(camera.size[0] - 1) / 2, (camera.size[1] - 1) / 2];
  const right = scale(cross(camera.direction, camera.up), (x - mx) * camera.pixel_spacing);
  return add(add(camera.center, right), scale(camera.up, (my - y) * camera.pixel_spacing));
}

const differs = (a: Pixels, b: Pixels) => difference(a, b, SAME_CODE) !== null;

/** Shows a view in which branches overlap and none lies in the picture plane. */
async function showOverlap(): Promise<void> {
  await viewer.look('l', 'A', 'S');
  await viewer.drag([0.5, 0.4], [12, 18]);
  await viewer.rest();
}

test('the page shows a phantom with letters, scale bar, cube, device and time', async () => {
  expect(isEmpty(await viewer.pixels())).toBe(false);
  const pane = viewer.pane();
  await expect(pane.locator('.edge.left')).toHaveText('R');
  await expect(pane.locator('.edge.top')).toHaveText('S');
  await expect(pane.getByRole('img', { name: /scale bar of \d+ mm/ })).toBeVisible();
  await expect(pane.getByRole('img', { name: 'orientation of the view' })).toContainText('A');
  await expect(viewer.device).toHaveText(/^CPU: \d+ threads?$/);
  await expect(viewer.page.locator('.frame-time')).toHaveText(/^\d+ ms$/);
  await viewer.screenshot('open');
});

test('a drag rotates about the cross-hair', async () => {
  const [before, camera] = [await viewer.picture(), await viewer.camera()];
  await viewer.drag([0.4, 0.4], [60, 25]);
  const after = await viewer.camera();
  expect(length(subtract(after.direction, camera.direction))).toBeGreaterThan(0.05);
  expect(length(after.direction)).toBeCloseTo(1, 9);
  expect(after.pixel_spacing).toBeCloseTo(camera.pixel_spacing, 9);
  expect(differs(await viewer.picture(), before)).toBe(true);
  await viewer.screenshot('rotated');
});

test('Alt and a drag rotate about the axis of the picked vessel', async () => {
  const camera = await viewer.camera();
  await viewer.drag([0.4, 0.4], [50, 0], { modifier: 'Alt' });
  expect(length(subtract((await viewer.camera()).direction, camera.direction))).toBeGreaterThan(0.05);
});

test('the wheel zooms, and the point under the pointer stays', async () => {
  const camera = await viewer.camera();
  // The browser rounds wheel positions to integer pixels of the page, but the view may start at a fraction.
  const box = await viewer.box();
  const at: Pair = [Math.round(box.x + 150) - box.x, Math.round(box.y + 90) - box.y];
  const kept = pointAt(camera, at);
  await viewer.wheel(at, -240);
  const after = await viewer.camera();
  expect(after.pixel_spacing).toBeLessThan(0.9 * camera.pixel_spacing);
  const [x, y] = pixelOf(after, kept);
  expect(x).toBeCloseTo(at[0], 1);
  expect(y).toBeCloseTo(at[1], 1);
});

for (const how of [{ modifier: 'Shift' }, { button: 'middle' }] as const) {
  test(`a drag with ${Object.values(how)[0]} pans by just as many pixels`, async () => {
    const camera = await viewer.camera();
    await viewer.drag([0.5, 0.5], [40, -30], how);
    const after = await viewer.camera();
    const [x, y] = pixelOf(after, camera.center);
    expect(x - (camera.size[0] - 1) / 2).toBeCloseTo(40, 1);
    expect(y - (camera.size[1] - 1) / 2).toBeCloseTo(-30, 1);
    expect(after.direction).toEqual(camera.direction);
  });
}

for (const how of [{ button: 'right' }, { modifier: 'Control' }] as const) {
  test(`a drag with ${Object.values(how)[0]} changes the window, which Ctrl and z undo`, async () => {
    const [before, text] = [await viewer.picture(), (await viewer.window.textContent()) ?? ''];
    const camera = await viewer.camera();
    await viewer.drag([0.5, 0.5], [50, 40], how);
    await expect(viewer.window).not.toHaveText(text);
    expect(await viewer.camera()).toEqual(camera);
    expect(differs(await viewer.picture(), before)).toBe(true);
    await viewer.press('Control+z');
    await expect(viewer.window).toHaveText(text);
  });
}

test('Escape undoes a drag', async () => {
  const state = await viewer.state();
  await viewer.drag([0.5, 0.5], [90, 40], { isHeld: true });
  expect(await viewer.state()).not.toEqual(state);
  await viewer.press('Escape');
  expect(await viewer.state()).toEqual(state);
  await viewer.page.mouse.up();
  expect(await viewer.state()).toEqual(state);
});

test('keys show the six sides of the patient', async () => {
  await viewer.look('a', 'R', 'S');
  await viewer.look('p', 'L', 'S');
  await viewer.look('l', 'A', 'S');
  await viewer.look('Shift+R', 'P', 'S');
  await viewer.look('Shift+S', 'L', 'A');
  await viewer.look('Shift+I', 'R', 'A');
  await viewer.look('a', 'R', 'S');
});

test('keys, the window strip and its list choose the window', async () => {
  const texts = new Set<string>();
  for (const key of ['1', '2', '3', '4', '5', '6', '7']) {
    await viewer.press(key);
    await viewer.rest();
    texts.add((await viewer.window.textContent()) ?? '');
  }
  expect(texts.size).toBeGreaterThanOrEqual(6);
  await viewer.press('2');
  await expect(viewer.window).toHaveText('W 900 L 300');
  const presets = viewer.page.getByLabel('Window preset');
  const chosen = presets.locator('option:checked');
  await expect(chosen).toHaveText('CT angiography (2)');
  await presets.selectOption({ label: 'Soft tissue (3)' });
  await expect(viewer.window).toHaveText('W 400 L 40');
  await expect(chosen).toHaveText('Soft tissue (3)');
  const narrow = viewer.page.viewportSize();
  await viewer.page.setViewportSize({ width: 1600, height: 560 });
  const level = viewer.page.getByRole('slider', { name: 'Level of the window' });
  await level.focus();
  await viewer.press('ArrowRight', 'ArrowRight');
  await expect(viewer.window).not.toHaveText('W 400 L 40');
  await expect(chosen).toHaveText('Custom window');
  const white = viewer.page.getByRole('slider', { name: 'White of the window' });
  const value = Number(await white.getAttribute('aria-valuenow'));
  const box = await white.boundingBox();
  if (box) {
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await viewer.page.mouse.move(x, y);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(x + 30, y, { steps: 3 });
    await viewer.page.mouse.up();
  }
  expect(Number(await white.getAttribute('aria-valuenow'))).toBeGreaterThan(value);
  await viewer.page.setViewportSize(narrow ?? { width: 800, height: 560 });
  await expect(level).toBeHidden();
  await viewer.reset();
});

test('silhouettes and inversion change the picture, and can be undone', async () => {
  await showOverlap();
  const first = await viewer.picture();
  await viewer.press('s');
  expect(differs(await viewer.picture(), first)).toBe(true);
  await viewer.press('s');
  expect(differs(await viewer.picture(), first)).toBe(false);
  await viewer.press('i');
  await expect(viewer.pane().locator('canvas')).toHaveClass(/inverted/);
  await viewer.press('i');
});

test('space turns until it is pressed again', async () => {
  await viewer.reset();
  const [camera, before] = [await viewer.camera(), await viewer.picture()];
  await viewer.press(' ');
  await expect.poll(async () => differs(await viewer.pixels(), before)).toBe(true);
  await viewer.press(' ');
  await viewer.rest();
  const turned = await viewer.camera();
  expect(length(subtract(turned.direction, camera.direction))).toBeGreaterThan(0.001);
  expect(await viewer.camera()).toEqual(turned);
  await viewer.reset();
  expect((await viewer.camera()).direction).toEqual(camera.direction);
});

test('arrow keys turn the view that has the focus, + and - zoom', async () => {
  const camera = await viewer.camera();
  await viewer.pane().focus();
  await viewer.press('ArrowLeft', '+');
  const after = await viewer.camera();
  expect(after.direction).not.toEqual(camera.direction);
  expect(after.pixel_spacing).toBeCloseTo(camera.pixel_spacing / 1.2, 6);
  await viewer.reset();
});

test('each method shows another picture', async () => {
  await showOverlap();
  const pictures: Pixels[] = [];
  const list = viewer.field('Method');
  await viewer.research(async () => {
    for (const method of ['csr', 'csr-paper', 'cr', 'mpcpr']) {
      await list.selectOption(method);
      const picture = await viewer.picture();
      expect(pictures.every((other) => differs(picture, other))).toBe(true);
      pictures.push(picture);
      await viewer.screenshot(`method-${method}`);
    }
    await list.selectOption('csr');
  });
  await expect(viewer.problem).toHaveCount(0);
});

test('the help lists every row of the table of bindings', async () => {
  const begin = viewer.page.getByRole('button', { name: 'Keys and mouse' });
  await begin.click();
  const help = viewer.page.getByRole('dialog', { name: 'Keys and mouse' });
  await expect(help).toBeVisible();
  await expect(help.getByText('In the turning view')).toBeInViewport();
  expect(await help.locator('dd').allTextContents()).toEqual(
    ['turning', 'flat', 'tracing', 'marks', 'everywhere'].flatMap((where) =>
      BINDINGS.filter((row) => row.where === where).map((row) => row.words),
    ),
  );
  await viewer.screenshot('help');
  await viewer.press('Escape');
  await expect(help).toBeHidden();
  await expect(begin).toBeFocused();
  await viewer.press('?');
  await expect(help).toBeVisible();
  // Closed and opened before the page draws itself again.
  await viewer.page.evaluate(() => {
    document.querySelector('dialog.help')?.dispatchEvent(new Event('cancel'));
    document.querySelector<HTMLDialogElement>('dialog.help')?.close();
    document.querySelector<HTMLButtonElement>('button[aria-label="Keys and mouse"]')?.click();
  });
  await expect(help).toBeVisible();
  await viewer.press('?');
  await expect(help).toBeHidden();
});

test('a picture is saved with and without labels', async () => {
  await viewer.look('a', 'R', 'S');
  const summary = viewer.page.getByText('Save', { exact: true });
  for (const kind of ['with', 'without']) {
    await summary.click();
    const download = viewer.page.waitForEvent('download');
    await viewer.page.getByRole('button', { name: `Picture ${kind} labels (PNG)` }).click();
    expect((await download).suggestedFilename()).toMatch(/-picture-anterior-\d{4}-\d\d-\d\d-\d{4}\.png$/);
  }
});
