/** Tests of opening, cancelling and closing, with complete, broken, slow and repeated voxel streams. */
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { type Browser, expect, type Page, test } from '@playwright/test';
import { difference, isEmpty, type Pixels, SAME_CODE } from './compare';
import { Viewer } from './page';
import { CENTERLINE, header, VOLUME, voxels, WHOLE } from './streams';

const ADDRESSES = '?volume=made/volume&centerlines=made/axis.vtk&device=cpu&test=1';
const MEGABYTE = 1 << 20;
/** Size of the turning view where many pictures are compared (CSS pixels). */
const SMALL_VIEW = [240, 180] as const;

async function serve(page: Page, volume: Buffer | number, axis = CENTERLINE): Promise<void> {
  await page.route('**/made/volume', (route) =>
    typeof volume === 'number' ? route.fulfill({ status: volume }) : route.fulfill({ body: volume }),
  );
  await page.route('**/made/axis.vtk', (route) => route.fulfill({ body: axis }));
}

test.describe('streams', () => {
  let viewer: Viewer;

  test.beforeAll(async ({ browser }) => {
    viewer = await Viewer.open(browser, '?device=cpu');
  });
  test.beforeEach(() => {
    viewer.faults.length = 0;
  });
  test.afterEach(async () => {
    await viewer.page.unrouteAll({ behavior: 'ignoreErrors' });
  });
  test.afterAll(() => viewer.close());

  test('a volume and its centerlines are shown', async () => {
    await serve(viewer.page, WHOLE);
    await viewer.page.goto(`./${ADDRESSES}`);
    await viewer.rest();
    expect(isEmpty(await viewer.pixels())).toBe(false);
    await viewer.click([0.5, 0.5]);
    await expect(viewer.readOut).toHaveText(/ · 350 HU · vessel 1 · \d+\.\d mm$/);
    viewer.expectNoFault();
  });

  test('each context and a slab show another picture', async () => {
    await serve(viewer.page, WHOLE);
    await viewer.page.goto(`./${ADDRESSES}`);
    await viewer.pin(SMALL_VIEW);
    await viewer.rest();
    // Outside the volume the cut ends, and what lies behind it is visible.
    await viewer.drag([0.5, 0.3], [50, 60]);
    await viewer.pane().focus();
    await viewer.press('-', '-', '-', '-', '-');
    const pictures: Pixels[] = [];
    const expectNew = async () => {
      const picture = await viewer.picture();
      for (const before of pictures) {
        expect(
          difference(picture, before, SAME_CODE),
          await viewer.field('Context').inputValue(),
        ).not.toBeNull();
      }
      pictures.push(picture);
    };
    await viewer.research(async () => {
      for (const context of ['mida', 'dvr', 'mip', 'minip', 'average', '']) {
        await viewer.field('Context').selectOption(context);
        await expectNew();
      }
      await viewer.field('Slab').fill('6');
      await viewer.press('Enter');
      await expectNew();
      await viewer.field('Slab').fill('0');
      await viewer.press('Enter');
    });
    const without = await viewer.picture();
    await viewer.page.locator('body').click({ position: { x: 2, y: 2 } });
    await viewer.press('c');
    expect(difference(await viewer.picture(), without, SAME_CODE)).not.toBeNull();
    await expect(viewer.field('Context')).toHaveValue('mida');
    await viewer.press('c');
    expect(difference(await viewer.picture(), without, SAME_CODE)).toBeNull();
    viewer.expectNoFault();
  });

  test('each look has a button, and a slider sets the margin of the cut', async () => {
    await serve(viewer.page, WHOLE);
    await viewer.page.goto(`./${ADDRESSES}`);
    await viewer.pin(SMALL_VIEW);
    await viewer.rest();
    const button = (words: string) => viewer.page.getByRole('button', { name: words, exact: true });
    await expect(button('Lumen in 3D')).toHaveAttribute('aria-pressed', 'true');
    await button('Lumen').click();
    const everywhere = await viewer.picture();
    const pictures = [everywhere];
    for (const look of ['Thick slab', 'MIP', 'Body in 3D', 'Lumen in 3D']) {
      await button(look).click();
      await expect(button(look)).toHaveAttribute('aria-pressed', 'true');
      await expect(viewer.page.locator('.looks [aria-pressed=true]')).toHaveCount(1);
      const picture = await viewer.picture();
      for (const before of pictures) {
        expect(difference(picture, before, SAME_CODE), look).not.toBeNull();
      }
      pictures.push(picture);
    }
    const [focused] = pictures.slice(-1);
    await viewer.field('Margin around the vessels').fill('12');
    expect(difference(await viewer.picture(), focused ?? everywhere, SAME_CODE)).not.toBeNull();
    await expect(button('Lumen in 3D')).toHaveAttribute('aria-pressed', 'true');
    await button('Lumen').click();
    expect(difference(await viewer.picture(), everywhere, SAME_CODE)).toBeNull();
    await expect(viewer.field('Margin around the vessels')).toHaveCount(0);
    viewer.expectNoFault();
  });

  test('a scan is closed, and the start page is back', async () => {
    await viewer.page.goto('./?phantom=stenosis&device=cpu');
    await viewer.rest();
    await viewer.page.getByRole('button', { name: 'Close the scan' }).click();
    await expect(viewer.page.getByRole('heading', { name: 'Lumencut' })).toBeVisible();
    await viewer.page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
    await viewer.rest();
    expect(isEmpty(await viewer.pixels())).toBe(false);
    viewer.expectNoFault();
  });

  const short = WHOLE.subarray(0, WHOLE.length - 1000);
  const broken: readonly (readonly [string, Buffer | number, RegExp])[] = [
    [
      'is cut off',
      short,
      new RegExp(`Found ${short.length} bytes; expected ${WHOLE.length} bytes\\.Open it again`),
    ],
    [
      'is another file',
      Buffer.from('not a stream at all'),
      /Found (another file|a file of unknown format); expected /,
    ],
    ['is empty', Buffer.alloc(0), /Found (another|an empty) file; expected /],
    ['has voxels of no known type', anotherType(), /type of the voxels.*Found complex64; expected uint8/],
    [
      'has an invalid header',
      header({}, 'LCVOLUME', '{"size":[1,'),
      /header of the volumeFound a text that is not JSON; expected size, dtype/,
    ],
    [
      'has a header without a size',
      header({ dtype: 'int16' }),
      /header of the volumeFound only dtype; expected size, dtype/,
    ],
    [
      'is larger than all memory',
      header({ ...VOLUME, size: [90_000, 90_000, 90_000] }),
      /Found .*; expected /,
    ],
    ['is not there', 404, /Found HTTP status 404; expected a file\.Check the program/],
  ];
  for (const [n, [what, volume, words]] of broken.entries()) {
    test(`a volume that ${what} is refused in words, and the page goes on`, async () => {
      await serve(viewer.page, volume);
      await viewer.page.goto(`./${ADDRESSES}`);
      await expect(viewer.problem).toHaveText(words);
      await expect(viewer.problem).not.toContainText('undefined');
      await expect(viewer.page.getByRole('heading', { name: 'Lumencut' })).toBeVisible();
      await viewer.screenshot(`broken-${what.replaceAll(' ', '-')}`);
      await viewer.problem.getByRole('button', { name: 'Close' }).click();
      await expect(viewer.problem).toHaveCount(0);
      if (n === 0) {
        await viewer.page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
        await viewer.rest();
      }
      // The browser itself also reports the failed request (404).
      expect(viewer.faults.filter((fault) => !fault.includes('404'))).toEqual([]);
    });
  }

  test('an invalid centerline file is rejected with an explanation', async () => {
    await serve(viewer.page, WHOLE, 'nothing of the kind');
    await viewer.page.goto(`./${ADDRESSES}`);
    await expect(viewer.problem).toHaveText(/Found .*; expected .*/);
    viewer.expectNoFault();
  });

  test('loading is cancelled by a button and by Escape', async () => {
    for (const how of ['button', 'Escape']) {
      await viewer.page.goto('./?volume=slow/volume&device=cpu');
      await expect(viewer.page.getByText(/^Volume: \d+ %$/)).toBeVisible();
      await viewer.screenshot('loading');
      if (how === 'button') {
        await viewer.page.getByRole('button', { name: 'Cancel' }).click();
      } else {
        await viewer.press('Escape');
      }
      await expect(viewer.page.getByRole('progressbar')).toHaveCount(0);
      await expect(viewer.problem).toHaveCount(0);
    }
    await viewer.page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
    await viewer.rest();
    viewer.expectNoFault();
  });

  test('addresses of another origin are not requested', async () => {
    await viewer.page.goto('./?volume=https://example.org/volume&device=cpu');
    await expect(viewer.page.getByRole('button', { name: 'Aorta' })).toBeEnabled();
    viewer.expectNoFault();
  });

  test('an address with an invalid view shows the first view', async () => {
    for (const [n, fragment] of [
      '#v1=%7Bbroken',
      '#v1=%7B%22camera%22%3A5%2C%22settings%22%3A%7B%22levels%22%3A%22x%22%7D%7D',
    ].entries()) {
      // Another query, since a change of the fragment alone does not load the page.
      await viewer.page.goto(`./?phantom=y_junction&device=cpu&n=${n}${fragment}`);
      await viewer.rest();
      expect(isEmpty(await viewer.pixels())).toBe(false);
      await expect(viewer.problem).toHaveCount(0);
    }
  });
});

function anotherType(): Buffer {
  return Buffer.concat([header({ ...VOLUME, dtype: 'complex64' }), voxels(VOLUME)]);
}

function openAndClose(page: Page, times: number): Promise<void> {
  return page.evaluate(async (count) => {
    const until = async <T>(found: () => T | null | undefined | false): Promise<T> => {
      for (;;) {
        const what = found();
        if (what) {
          return what;
        }
        await new Promise((resolve) => setTimeout(resolve, 10));
      }
    };
    for (let n = 0; n < count; n++) {
      const phantom = () => [...document.querySelectorAll<HTMLButtonElement>('.phantoms button')].at(-1);
      (await until(phantom)).click();
      await until(() => document.querySelector<HTMLElement>('canvas.picture')?.dataset.pixels);
      (await until(() => document.querySelector<HTMLButtonElement>('[aria-label="Close the scan"]'))).click();
    }
    await until(() => document.querySelector('.phantoms'));
  }, times);
}

test('opening a phantom 50 times does not increase the memory', { tag: '@long' }, async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?device=cpu&test=1');
  await expect(viewer.page.getByRole('button', { name: 'Aorta' })).toBeEnabled();
  await viewer.page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
  await viewer.rest();
  await viewer.page.getByRole('button', { name: 'Close the scan' }).click();
  await openAndClose(viewer.page, 10);
  const before = await viewer.memory();
  await openAndClose(viewer.page, 40);
  expect(before).toBeGreaterThan(MEGABYTE);
  // If a volume or picture were leaked at each opening, memory would grow far more.
  expect((await viewer.memory()) - before).toBeLessThan(5 * MEGABYTE);
  viewer.expectNoFault();
  await viewer.close();
});

async function openedAlone(browser: Browser, phantom: string): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?device=cpu');
  await viewer.page.route(
    ({ pathname }) => pathname === '/',
    async (route) => {
      const {
        'cross-origin-opener-policy': _,
        'cross-origin-embedder-policy': __,
        ...headers
      } = (await route.fetch()).headers();
      await route.fulfill({ response: await route.fetch(), headers });
    },
  );
  await viewer.page.goto(`./?phantom=${phantom}&device=cpu`);
  await viewer.rest();
  return viewer;
}

test('without cross-origin isolation one thread computes, and the page says so', async ({ browser }) => {
  const viewer = await openedAlone(browser, 'stenosis');
  await expect(viewer.device).toHaveText('CPU: 1 thread, because the page is not cross-origin isolated');
  expect(isEmpty(await viewer.pixels())).toBe(false);
  const before = await viewer.camera();
  await viewer.drag([0.5, 0.5], [30, 10]);
  await viewer.rest();
  expect(await viewer.camera()).not.toEqual(before);
  viewer.expectNoFault();
  await viewer.close();
});

test('without shared memory, the page says that work runs to its end @long', async ({ browser }) => {
  const viewer = await openedAlone(browser, 'aorta');
  await viewer.press('v');
  await viewer.page.getByRole('button', { name: 'Find all vessels' }).click();
  await viewer.page.getByRole('button', { name: 'Cancel' }).click();
  const running = viewer.page.getByText('without shared memory it cannot be stopped');
  await expect(running).toBeVisible();
  await expect(running).toHaveCount(0);
  await expect(viewer.page.getByRole('button', { name: 'Undo' })).toBeDisabled();
  viewer.expectNoFault();
  await viewer.close();
});

test('an engine that does not load is reported', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?device=cpu');
  await viewer.page.route('**/assets/engine.worker-*.js', (route) => route.abort());
  await viewer.page.goto('./?device=cpu');
  await expect(viewer.problem).toContainText('Found a worker that did not load');
  await viewer.close();
});

test('a real scan is shown and turned', async ({ browser }, testInfo) => {
  const root = join(import.meta.dirname, '../..');
  const shared = join(root, '../shared/data');
  const python = process.env.LUMENCUT_PYTHON ?? join(root, '.venv/bin/python');
  test.skip(!existsSync(shared) || !existsSync(python), 'there are no real scans beside the repository');
  const [volume, axis] = [testInfo.outputPath('volume'), testInfo.outputPath('axis.vtp')];
  const made = spawnSync(python, [join(import.meta.dirname, 'stream.py'), shared, volume, axis], {
    encoding: 'utf-8',
  });
  expect(made.stderr).toBe('');
  const viewer = await Viewer.open(browser, '?device=cpu');
  await viewer.page.route('**/made/volume', (route) => route.fulfill({ path: volume }));
  await viewer.page.route('**/made/axis.vtp', (route) => route.fulfill({ body: readFileSync(axis) }));
  await viewer.page.goto('./?volume=made/volume&centerlines=made/axis.vtp&device=cpu');
  await viewer.rest();
  expect(isEmpty(await viewer.pixels())).toBe(false);
  await viewer.screenshot('scan');
  await viewer.drag([0.4, 0.5], [120, 10]);
  await viewer.click([0.5, 0.5]);
  await expect(viewer.readOut).toHaveText(/^[LR] \d+\.\d [AP] \d+\.\d [SI] \d+\.\d · -?\d+/);
  await viewer.field('Layout').selectOption('four');
  await viewer.rest();
  await viewer.screenshot('scan-four');
  viewer.expectNoFault();
  await viewer.close();
});
