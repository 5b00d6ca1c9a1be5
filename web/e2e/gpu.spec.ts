/** WebGPU: every shader compiles, the view is drawn, and a lost device is no loss. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from '@playwright/test';
import { difference, isEmpty, OTHER_DEVICE_WITH_CONTEXT } from './compare';
import { Viewer, viewFragment } from './page';

const CRATES = join(import.meta.dirname, '../../crates');
const CORE = join(CRATES, 'lumencut-core/src');
const ONE = viewFragment({ layout: 'one' });

/** A room of the shaders after all that it imports, each of them once. */
function assembled(room: string, seen = new Set<string>()): string {
  if (seen.has(room)) {
    return '';
  }
  seen.add(room);
  const text = readFileSync(join(CORE, `${room}.wgsl`), 'utf-8');
  const imports = [...text.matchAll(/^\/\/ import (\S+)/gm)].map(([, name]) => assembled(name ?? '', seen));
  return [...imports, text].join('\n');
}

/** All shaders by their names. */
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
  // One that is broken on purpose shows that errors are seen.
  expect(errors.filter((error) => !error.startsWith('broken:'))).toEqual([]);
  expect(errors).toHaveLength(1);
  viewer.expectNoFault();
  await viewer.close();
});

test('the GPU draws; lost, it comes back; lost again, the CPU shows the same', async ({ browser }) => {
  test.setTimeout(120_000);
  const viewer = await Viewer.open(browser, `?phantom=stenosis&device=any&test=1${ONE}`);
  await viewer.pin([240, 180]);
  await viewer.rest();
  await expect(viewer.device).toContainText('GPU');
  await viewer.drag([0.5, 0.4], [30, 20]);
  const [first, camera] = [await viewer.picture(), await viewer.camera()];
  expect(isEmpty(first)).toBe(false);
  await viewer.screenshot('gpu');

  await viewer.loseDevice();
  await viewer.press('s', 's');
  await expect(viewer.page.getByText(/1 note/)).toBeVisible({ timeout: 30_000 });
  await expect(viewer.device).toContainText('GPU');
  const second = await viewer.picture();
  expect(difference(second, first, OTHER_DEVICE_WITH_CONTEXT)).toBeNull();

  await viewer.loseDevice();
  await viewer.press('s', 's');
  await expect(viewer.device).toContainText('CPU', { timeout: 30_000 });
  await viewer.rest();
  expect(await viewer.camera()).toEqual(camera);
  const third = await viewer.picture();
  expect(isEmpty(third)).toBe(false);
  await viewer.screenshot('gpu-lost');
  await expect(viewer.problem).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});
