/** Pictures and positions of reformations equal those of the Python package (`expected/make_reformations.py`). */
import { readFileSync } from 'node:fs';
import { type Browser, expect, test } from '@playwright/test';
import type { Pair, Reformation, Vector } from '../src/core/messages';
import type { ViewState } from '../src/state/address';
import { difference, type Pixels, SAME_CODE } from './compare';
import { Viewer, viewFragment } from './page';

interface Expected {
  readonly name: string;
  readonly phantom: string;
  readonly pixel: Pair;
  readonly asked: Reformation;
  readonly pixel_spacing: number;
  readonly point: Vector;
}

const file = (name: string) => new URL(`./expected/${name}`, import.meta.url);
const table = JSON.parse(readFileSync(file('reformations.json'), 'utf-8')) as {
  readonly size: Pair;
  readonly window: Pair;
  readonly reformations: readonly Expected[];
};

/** Opens a phantom; the pane of the picked vessel has the size that the table of expected pictures requires. */
async function opened(browser: Browser, phantom: string, state: Partial<ViewState> = {}) {
  const fragment = viewFragment({ window: table.window, layout: 'two', vessel: 0, ...state });
  const viewer = await Viewer.open(browser, `?phantom=${phantom}&device=cpu${fragment}`);
  await viewer.rest();
  const [width, height] = table.size;
  await viewer.page.addStyleTag({
    content: `[data-testid=straightened] { position: absolute; width: ${width}px; height: ${height}px; inset: 0 auto auto 0; }`,
  });
  return viewer;
}

const choice = (viewer: Viewer, words: string) => viewer.page.getByLabel(words, { exact: true });

async function choose(viewer: Viewer, asked: Reformation): Promise<void> {
  await choice(viewer, 'Reformation').selectOption(asked.kind);
  if (asked.kind === 'uncurl') {
    const percent = String(Math.round(100 * asked.amount));
    await choice(viewer, 'How far the vessel is straightened (percent)').fill(percent);
  } else if (asked.kind === 'map') {
    await choice(viewer, 'What the map shows').selectOption(asked.of);
  } else if (asked.kind === 'endoscopy') {
    await choice(viewer, 'Lens').selectOption(asked.lens);
    await choice(viewer, 'look back').setChecked(asked.backwards);
  }
}

for (const row of table.reformations) {
  test(`${row.name} is the native picture, and a click in it puts the cross-hair where Python tells`, async ({
    browser,
  }) => {
    const { asked } = row;
    const viewer = await opened(browser, row.phantom, {
      ...('vessel' in asked && { vessel: asked.vessel }),
      ...('angle' in asked && { angle: asked.angle }),
      ...('at' in asked && { place: asked.at }),
    });
    await choose(viewer, asked);
    const expected = await decoded(viewer, `${row.name}.png`);
    await expect(async () => {
      const found = await viewer.pixels('straightened');
      expect([found.width, found.height]).toEqual([expected.width, expected.height]);
      expect(difference(found, expected, SAME_CODE)).toBeNull();
    }).toPass();
    await expect(viewer.page.locator('.reformed .axes')).toContainText('vessel');
    await expect(viewer.pane('straightened').getByTestId('vessel-name')).toHaveCount(
      asked.kind === 'untangled' ? 0 : 1,
    );
    await viewer.screenshot(`reformation-${row.name}`);
    const [left, top] = [table.size[0] - expected.width, table.size[1] - expected.height];
    const at: Pair = [Math.floor(left / 2) + row.pixel[0] + 0.5, Math.floor(top / 2) + row.pixel[1] + 0.5];
    await viewer.click(at, 'straightened');
    await expect.poll(async () => (await viewer.state()).hair !== undefined).toBe(true);
    const hair = (await viewer.state()).hair ?? [0, 0, 0];
    const away = Math.hypot(...row.point.map((place, n) => place - (hair[n] ?? 0)));
    expect(away).toBeLessThan(row.pixel_spacing);
    // The cross-hair is at the clicked pixel; in a lumen map, on the ray of that pixel.
    await expect
      .poll(async () => {
        const [x, y] = await viewer.hair('straightened');
        return Math.max(Math.abs(x - at[0]), Math.abs(y - at[1]));
      })
      .toBeLessThan(1.5);
    viewer.expectNoFault();
    await viewer.close();
  });
}

test('the wheel moves the eye of an endoscopy with the section, and a click leaves both where they are', async ({
  browser,
}) => {
  const viewer = await opened(browser, 'stenosis', { place: 20 });
  await choice(viewer, 'Reformation').selectOption('endoscopy');
  const axes = viewer.page.locator('.reformed .axes');
  await expect(axes).toContainText('20.0 mm from its start');
  await viewer.wheel([120, 100], 300, 'straightened');
  await expect(axes).not.toContainText('20.0 mm from its start');
  const place = (await viewer.state()).place ?? 0;
  expect(place).toBeGreaterThan(20);
  await expect(axes).toContainText(`${place.toFixed(1)} mm from its start`);
  const before = (await viewer.state()).hair;
  await viewer.click([40, 40], 'straightened');
  await expect.poll(async () => (await viewer.state()).hair).not.toEqual(before);
  expect((await viewer.state()).place).toBe(place);
  await choice(viewer, 'look back').check();
  await viewer.rest();
  await viewer.screenshot('reformation-endoscopy-back');
  viewer.expectNoFault();
  await viewer.close();
});

test('a click in a CFA picks the point that it shows, and a CPR that follows the lumen has no angle', async ({
  browser,
}) => {
  const viewer = await opened(browser, 'y_junction');
  await choice(viewer, 'What a pixel shows').selectOption('max');
  await viewer.click([0.6, 0.5], 'straightened');
  await expect(viewer.readOut).toHaveText(/ · \S.* · \d+\.\d mm$/);
  await choice(viewer, 'What a pixel shows').selectOption('');
  const before = await viewer.pixels('straightened');
  await choice(viewer, 'What a pixel shows').selectOption('narrowest');
  await expect(choice(viewer, 'Rotation about the vessel (degrees)')).toBeDisabled();
  await expect
    .poll(async () => difference(await viewer.pixels('straightened'), before, SAME_CODE))
    .not.toBeNull();
  await viewer.screenshot('reformation-roll');
  viewer.expectNoFault();
  await viewer.close();
});

async function decoded(viewer: Viewer, name: string): Promise<Pixels> {
  const address = `data:image/png;base64,${readFileSync(file(name)).toString('base64')}`;
  const { width, height, bytes } = await viewer.page.evaluate(async (from) => {
    const image = new Image();
    image.src = from;
    await image.decode();
    const copy = new OffscreenCanvas(image.width, image.height).getContext('2d');
    copy?.drawImage(image, 0, 0);
    const { width, height } = image;
    return { width, height, bytes: Array.from(copy?.getImageData(0, 0, width, height).data ?? []) };
  }, address);
  return { width, height, bytes: Uint8Array.from(bytes) };
}
