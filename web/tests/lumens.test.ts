/** Of the lumens under the pointer the nearest is selected; the wheel steps to those behind. */
import { beforeEach, expect, test } from 'vitest';
import type { Asked, PointedAt, PointedLumen, Vector } from '../src/core/messages';
import { actionOf } from '../src/input/bindings';
import { lookForLumens, meant, pointed, stepLumen } from '../src/state/lumens';
import { ofCamera } from '../src/views/projection';
import { connect } from '../src/worker/engine';
import { CAMERA, expectNear } from './helpers';

const lumen = (depth: number): PointedLumen => ({
  point: [0, depth, 0],
  center: [0, depth, 0.5],
  diameter: 6,
  value: 300,
  right: [1, 0, 0],
  down: [0, 0, -1],
});
const [NEAR, FAR] = [lumen(10), lumen(40)] as const;
const ASKED: PointedAt = { point: [0, 0, 0], along: [0, 1, 0] };

const engineOf = (lumens: readonly PointedLumen[] | null): Asked =>
  ({ ask: () => (lumens ? Promise.resolve(lumens) : Promise.reject(new Error('no volume'))) }) as never;

beforeEach(() => {
  pointed.value = null;
});

test('the nearest lumen is selected, and steps reach only those behind it', async () => {
  connect(engineOf([NEAR, FAR]));
  expect(await lookForLumens(['turning', [3, 4]], ASKED)).toBe(NEAR);
  expect(meant.value).toBe(NEAR);
  expect([stepLumen(1), meant.value]).toEqual([true, FAR]);
  expect([stepLumen(1), meant.value]).toEqual([true, FAR]);
  expect([stepLumen(-3), meant.value]).toEqual([true, NEAR]);
});

test('a selected lumen stays selected while it is under the pointer; then the nearest one is selected', async () => {
  connect(engineOf([NEAR, FAR]));
  await lookForLumens(['turning', [3, 4]], ASKED);
  stepLumen(1);
  const further: PointedLumen = { ...FAR, center: [2, 40, 0.5] };
  connect(engineOf([NEAR, further]));
  expect(await lookForLumens(['turning', [4, 4]], ASKED)).toBe(further);
  const other: PointedLumen = { ...FAR, center: [9, 40, 0.5] };
  connect(engineOf([NEAR, other]));
  expect(await lookForLumens(['turning', [9, 9]], ASKED)).toBe(NEAR);
});

test('without a lumen, or without an open scan, none is selected and there are no steps', async () => {
  for (const engine of [engineOf([]), engineOf(null)]) {
    connect(engine);
    expect(await lookForLumens(['axial', [0, 0]], { ...ASKED, along: null })).toBeNull();
    expect([meant.value, stepLumen(1)]).toEqual([null, false]);
  }
  connect(engineOf([NEAR]));
  await lookForLumens(['axial', [0, 0]], ASKED);
  expect(stepLumen(1)).toBe(false);
});

test('while tracing, the wheel with Alt steps, and without Alt it acts as before', () => {
  expect(actionOf('tracing', 'wheel', null, 'Alt')).toBe('step');
  expect(actionOf('tracing', 'wheel', null, '')).toBeNull();
});

test('the ray of a pixel runs along the view direction through every point seen at this pixel', () => {
  const volume = {
    size: [1, 1, 1],
    world_from_index: [],
    corners: [],
    smallest_side: 1,
    pixel_side: 0.25,
    scan: '',
    doubt: null,
    notes: [],
    contours: [],
  } as const;
  const projection = ofCamera(CAMERA, volume);
  const from = projection.at([120, 80], [0, 0, 0]);
  const along = projection.along as Vector;
  for (const depth of [0, 25]) {
    const place = from.map((part, axis) => part + depth * (along[axis] ?? 0)) as unknown as Vector;
    expectNear(projection.pixel(place), [120, 80]);
  }
});
