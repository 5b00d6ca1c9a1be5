/** Tests of WebGPU: all shaders compile, the view is drawn, and a lost device is replaced. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { type Browser, expect, test } from '@playwright/test';
import { difference, isEmpty, OTHER_DEVICE_WITH_CONTEXT, type Pixels } from './compare';
import { button, startTracing, traced } from './controls';
import { Viewer, viewFragment } from './page';

const CRATES = join(import.meta.dirname, '../../crates');
const CORE = join(CRATES, 'lumencut-core/src');
/** Forces supersampling even on a busy machine. */
const SAMPLED = { samples: 2 };
const ONE = viewFragment({ layout: 'one', settings: SAMPLED });

/** Source of a shader, in which each imported module is included once. */
function assembled(room: string, seen = new Set<string>()): string {
  if (seen.has(room)) {
    return '';
  }
  seen.add(room);
  const text = readFileSync(join(CORE, `${room}.wgsl`), 'utf-8');
  const imports = [...text.matchAll(/^\/\/ import (\S+)/gm)].map(([, name]) => assembled(name ?? '', seen));
  return [...imports, text].join('\n');
}

function shaders(): (readonly [string, string])[] {
  const rooms = readdirSync(CORE, { recursive: true, encoding: 'utf-8' })
    .filter((name) => name.endsWith('.wgsl'))
    .map((name) => name.slice(0, -'.wgsl'.length));
  const screen = readFileSync(join(CRATES, 'lumencut-gpu/src/screen.wgsl'), 'utf-8');
  return [...rooms.map((room) => [room, assembled(room)] as const), ['screen', screen]];
}

test('every shader compiles in the browser', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?device=cpu');
  const all = shaders();
  expect(all.length).toBeGreaterThan(10);
  const errors = await viewer.page.evaluate(async (sources) => {
    const gpu = (navigator as unknown as { gpu: { requestAdapter(): Promise<Adapter | null> } }).gpu;
    interface Message {
      readonly type: string;
      readonly message: string;
      readonly lineNum: number;
    }
    interface Module {
      getCompilationInfo(): Promise<{ messages: Message[] }>;
    }
    interface Device {
      pushErrorScope(kind: string): void;
      popErrorScope(): Promise<unknown>;
      createShaderModule(code: { code: string }): Module;
    }
    interface Adapter {
      requestDevice(): Promise<Device>;
    }
    const device = await (await gpu.requestAdapter())?.requestDevice();
    const found: string[] = device ? [] : ['there is no adapter'];
    for (const [name, code] of device ? [...sources, ['broken', 'fn f() -> u32 { return 1.5; }']] : []) {
      device?.pushErrorScope('validation');
      const info = await device?.createShaderModule({ code: code ?? '' }).getCompilationInfo();
      await device?.popErrorScope();
      const errors = info?.messages.filter(({ type }) => type === 'error') ?? [];
      found.push(...errors.map(({ lineNum, message }) => `${name}:${lineNum}: ${message.slice(0, 200)}`));
    }
    return found;
  }, all);
  // A deliberately broken shader proves that errors are reported.
  expect(errors.filter((error) => !error.startsWith('broken:'))).toEqual([]);
  expect(errors).toHaveLength(1);
  viewer.expectNoFault();
  await viewer.close();
});

/** Few enough pixels for supersampling by a software GPU. */
const SMALL_VIEW = [160, 120] as const;

/** The supersampled picture of the view, which must be equal on every device. */
async function complete(viewer: Viewer): Promise<Pixels> {
  await viewer.rest();
  return viewer.pixels();
}

async function crashGpu(browser: Browser): Promise<void> {
  const session = await browser.newBrowserCDPSession();
  // This protocol command is missing in the types of Playwright.
  await session.send('Browser.crashGpuProcess' as 'Browser.close');
  await session.detach();
}

test('the GPU draws; after a loss it recovers; after a second loss the CPU shows the same', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, `?phantom=stenosis&device=any${ONE}`);
  await viewer.pin(SMALL_VIEW);
  await viewer.rest();
  await expect(viewer.device).toContainText('GPU');
  await viewer.drag([0.5, 0.4], [30, 20]);
  const [first, camera] = [await complete(viewer), await viewer.camera()];
  expect(isEmpty(first)).toBe(false);
  await viewer.screenshot('gpu');

  await crashGpu(browser);
  await expect(viewer.page.getByText(/1 note/)).toBeVisible();
  const second = await complete(viewer);
  await viewer.screenshot('gpu-back');
  expect(difference(second, first, OTHER_DEVICE_WITH_CONTEXT)).toBeNull();
  expect(await viewer.camera()).toEqual(camera);
  await viewer.drag([0.5, 0.4], [-12, 8]);
  await viewer.rest();
  await expect(viewer.device).toContainText('GPU');
  await expect(viewer.page.getByText(/1 note/)).toBeVisible();
  const turned = await viewer.camera();

  await crashGpu(browser);
  await expect(viewer.device).toContainText('CPU');
  await viewer.rest();
  expect(await viewer.camera()).toEqual(turned);
  const third = await viewer.picture();
  expect(isEmpty(third)).toBe(false);
  await viewer.screenshot('gpu-lost');
  await expect(viewer.problem).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});

/** Pictures of the phantom "junction": without vessels, with a traced vessel, and after undo. */
async function tracedOn(browser: Browser, device: 'any' | 'cpu'): Promise<[Pixels, Pixels, Pixels]> {
  const viewport = { width: 1100, height: 720 };
  const viewer = await Viewer.open(
    browser,
    `?phantom=y_junction&device=${device}${viewFragment({ settings: SAMPLED })}`,
    { viewport },
  );
  await expect(viewer.pane()).toBeVisible();
  await expect(viewer.device).toContainText(device === 'any' ? 'GPU' : 'CPU');
  await viewer.press('v');
  await button(viewer, 'Delete all').click();
  await expect(viewer.pane('straightened')).toContainText('once there is a vessel');
  await viewer.pin(SMALL_VIEW);
  await viewer.drag([0.3, 0.4], [25, 15]);
  const before = await complete(viewer);
  await startTracing(viewer);
  const [width, height] = await viewer.size('coronal');
  for (const [across, down] of [
    [0, 0.8],
    [-0.19, 0.22],
  ] as const) {
    await viewer.click([Math.round(width / 2 + across * height), Math.round(down * height)], 'coronal');
  }
  await traced(viewer, 1);
  await button(viewer, 'Done').click();
  const after = await complete(viewer);
  await viewer.screenshot(`traced-${device}`);
  await viewer.press('Control+z');
  await expect(viewer.pane('straightened')).toContainText('once there is a vessel');
  const undone = await complete(viewer);
  viewer.expectNoFault();
  await viewer.close();
  return [before, after, undone];
}

test('a vessel traced by two clicks is cut open on the GPU as on the CPU', { tag: '@long' }, async ({
  browser,
}) => {
  const onGpu = await tracedOn(browser, 'any');
  const [before, after, undone] = onGpu;
  expect(difference(after, before, OTHER_DEVICE_WITH_CONTEXT)).not.toBeNull();
  expect(difference(undone, before, OTHER_DEVICE_WITH_CONTEXT)).toBeNull();
  for (const [n, picture] of (await tracedOn(browser, 'cpu')).entries()) {
    expect(isEmpty(picture)).toBe(false);
    expect(difference(onGpu[n] ?? picture, picture, OTHER_DEVICE_WITH_CONTEXT)).toBeNull();
  }
});

/** A focus with a margin smaller than the lumen, so that a single tube shows how the cut fades. */
const FADING = viewFragment({
  layout: 'one',
  settings: { ...SAMPLED, focus: [-2, 4], context_shading: true },
});

/** Small pictures of a focus; on the CPU also of the view without a focus. */
async function focusedOn(browser: Browser, device: 'any' | 'cpu'): Promise<Pixels[]> {
  const viewer = await Viewer.open(browser, `?phantom=stenosis&device=${device}${FADING}`);
  await expect(viewer.pane()).toBeVisible();
  await expect(viewer.device).toContainText(device === 'any' ? 'GPU' : 'CPU');
  await viewer.pin([64, 48]);
  const pictures = [await complete(viewer)];
  await viewer.screenshot(`focus-${device}`);
  if (device === 'cpu') {
    await button(viewer, 'Lumen').click();
    pictures.push(await complete(viewer));
  }
  viewer.expectNoFault();
  await viewer.close();
  return pictures;
}

test('a focus is the same on both', { tag: '@long' }, async ({ browser }) => {
  const found = await focusedOn(browser, 'any');
  const [focused, cut] = await focusedOn(browser, 'cpu');
  expect(focused && cut).toBeDefined();
  if (focused && cut) {
    expect(difference(focused, cut, OTHER_DEVICE_WITH_CONTEXT)).not.toBeNull();
    expect(difference(found[0] ?? cut, focused, OTHER_DEVICE_WITH_CONTEXT)).toBeNull();
  }
});
