/** The page renders the same pictures as the Python package (`expected/make.py`). */
import { readFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import {
  difference,
  isEmpty,
  OTHER_DEVICE,
  OTHER_DEVICE_WITH_CONTEXT,
  type Pixels,
  SAME_CODE,
} from './compare';
import { Viewer, viewFragment } from './page';

interface Expected {
  readonly name: string;
  readonly phantom: string;
  readonly method: string;
  readonly window: readonly [number, number];
  readonly camera: { readonly pixel_spacing: number };
  readonly settings: Readonly<Record<string, unknown>>;
}

const file = (name: string) => new URL(`./expected/${name}`, import.meta.url);
const { size, views } = JSON.parse(readFileSync(file('views.json'), 'utf-8')) as {
  size: readonly [number, number];
  views: readonly Expected[];
};
const [WIDTH, HEIGHT] = size;

async function shown(viewer: Viewer): Promise<{ found: Pixels; samples: number }> {
  await viewer.pin(size);
  const found = await viewer.picture();
  const stage = await viewer.stage();
  return { found, samples: stage === 'samples' ? 2 : 1 };
}

for (const view of views) {
  test(`${view.name} is the native picture`, async ({ browser }, { project }) => {
    const isGpu = project.name === 'gpu';
    const { window, method, settings } = view;
    const camera = { ...view.camera, height: Math.min(WIDTH, HEIGHT) };
    const state = { camera, window, method, settings, layout: 'one' };
    const query = `?phantom=${view.phantom}&device=${isGpu ? 'any' : 'cpu'}${viewFragment(state)}`;
    const viewer = await Viewer.open(browser, query, { deviceScaleFactor: 1 });
    const { found, samples } = await shown(viewer);
    await expect(viewer.device).toContainText(isGpu ? 'GPU' : 'CPU');
    const expected = await decoded(viewer, `${view.name}-${samples}.png`);
    const withContext = settings.context === undefined;
    const other = withContext ? OTHER_DEVICE_WITH_CONTEXT : OTHER_DEVICE;
    expect(difference(found, expected, isGpu ? other : SAME_CODE)).toBeNull();
    expect(isEmpty(found)).toBe(false);
    // Proves that the comparison detects an object of 8 pixels in the wrong position.
    const broken = expected.bytes.slice();
    broken.copyWithin(4 * (80 * WIDTH + 60), 4 * (80 * WIDTH + 90), 4 * (80 * WIDTH + 130));
    expect(difference(found, { ...expected, bytes: broken }, SAME_CODE)).not.toBeNull();
    viewer.expectNoFault();
    await viewer.close();
  });
}

async function decoded(viewer: Viewer, name: string): Promise<Pixels> {
  const address = `data:image/png;base64,${readFileSync(file(name)).toString('base64')}`;
  const bytes = await viewer.page.evaluate(async (from) => {
    const image = new Image();
    image.src = from;
    await image.decode();
    const copy = new OffscreenCanvas(image.width, image.height).getContext('2d');
    copy?.drawImage(image, 0, 0);
    return Array.from(copy?.getImageData(0, 0, image.width, image.height).data ?? []);
  }, address);
  return { width: WIDTH, height: HEIGHT, bytes: Uint8Array.from(bytes) };
}

interface Labelled {
  readonly camera: { readonly pixel_spacing: number };
  readonly letters: Readonly<Record<string, string>>;
  readonly words: string;
  readonly pixels: number;
}

// They do not depend on the device.
test('letters and scale bar equal those of the Python package', { tag: '@cpu' }, async ({ browser }) => {
  const { size, views } = JSON.parse(readFileSync(file('labels.json'), 'utf-8')) as {
    size: readonly [number, number];
    views: readonly Labelled[];
  };
  for (const { camera, letters, words, pixels } of views) {
    const state = { camera: { ...camera, height: Math.min(...size) }, layout: 'one' };
    const viewer = await Viewer.open(browser, `?phantom=y_junction&device=cpu${viewFragment(state)}`);
    await viewer.pin(size);
    await viewer.rest();
    for (const [edge, word] of Object.entries(letters)) {
      await expect(viewer.pane().locator(`.edge.${edge}`)).toHaveText(word);
    }
    const bar = viewer.pane().getByRole('img', { name: `scale bar of ${words}`, exact: true });
    await expect(bar).toHaveText(words);
    expect(Number(await bar.getAttribute('width')) - 2).toBeCloseTo(pixels, 6);
    viewer.expectNoFault();
    await viewer.close();
  }
});
