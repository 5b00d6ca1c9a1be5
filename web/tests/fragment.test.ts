import { afterEach, beforeEach, describe, expect, test } from 'vitest';
import type { SettingRow, Started } from '../src/core/messages';
import { currentState, fragmentOf, restore, stateOf } from '../src/state/address';
import * as store from '../src/state/store';
import { CAMERA, expectNear, random } from './helpers';

const ROW: SettingRow = {
  name: 'step',
  kind: 'number',
  optional: false,
  default: 0.5,
  low: 0.1,
  high: 2,
  unit: 'mm',
  choices: [],
  open: null,
  sentence: '',
};
const TABLE: readonly SettingRow[] = [
  ROW,
  { ...ROW, name: 'samples', kind: 'count', low: 1, high: 8 },
  { ...ROW, name: 'silhouettes', kind: 'flag', low: null, high: null },
  {
    ...ROW,
    name: 'context',
    kind: 'choice',
    optional: true,
    choices: ['mida', 'mip'],
    low: null,
    high: null,
  },
  { ...ROW, name: 'slab', kind: 'slab', optional: true, low: null, high: null },
  { ...ROW, name: 'silhouette_color', kind: 'color', low: null, high: null },
  { ...ROW, name: 'focus', kind: 'focus', optional: true, low: null, high: null },
];

beforeEach(() => {
  store.started.value = { table: TABLE } as unknown as Started;
  store.report.value = {
    volume: null,
    vessels: [
      { line: 0, name: 'left renal', length: 80, has_radius: true },
      { line: 1, name: 'aorta', length: 300, has_radius: true },
    ],
    windows: null,
  };
  store.studyName.value = 'DOE^JANE 1970';
  store.camera.value = CAMERA;
  store.crossHair.value = { point: [1, 2, 3], value: 312, vessel: 1, arcLength: 5 };
});

afterEach(() => {
  store.report.value = null;
  store.started.value = null;
  store.camera.value = null;
  store.crossHair.value = null;
  store.settings.value = {};
  store.window_.value = [300, 900];
  store.layout.value = 'strip';
  store.method.value = 'csr';
  store.pickedVessel.value = null;
});

const stateOfJson = (state: unknown) => stateOf(`#v1=${encodeURIComponent(JSON.stringify(state))}`);

test('a view can be written to the address and read back', () => {
  store.window_.value = [40, 400.5];
  store.method.value = 'mpcpr';
  store.layout.value = 'four';
  store.isInverted.value = true;
  store.settings.value = {
    step: 0.25,
    context: null,
    silhouettes: false,
    slab: [5, 'max'],
    focus: [2, 6],
    silhouette_color: [255, 255, 255],
  };
  store.pickedVessel.value = 1;
  store.pickedPlace.value = 12.3456;
  store.cprAngle.value = 0.7;
  const before = currentState();
  const fragment = `#${fragmentOf(before)}`;
  store.camera.value = { ...CAMERA, center: [0, 0, 0], pixel_spacing: 3 };
  store.window_.value = [1, 2];
  store.method.value = 'csr';
  store.layout.value = 'one';
  store.isInverted.value = false;
  store.settings.value = {};
  store.pickedVessel.value = 0;
  store.crossHair.value = null;
  restore(stateOf(fragment) ?? {});
  expect(currentState()).toEqual(before);
  expect(store.camera.value).toEqual(CAMERA);
});

test('a view of another scan changes nothing', () => {
  const state = stateOf(fragmentOf(currentState()));
  const volume = { size: [4, 5, 6], world_from_index: [[1, 0, 0, 2]] };
  store.report.value = { volume, vessels: null, windows: null } as never;
  store.method.value = 'csr';
  store.layout.value = 'one';
  const before = currentState();
  expect(restore({ ...state, method: 'mpcpr', layout: 'measure' })).toBe(false);
  expect(currentState()).toEqual(before);
  expect(restore({ ...state, scan: before.scan, layout: 'strip' } as never)).toBe(true);
  expect(store.layout.value).toBe('strip');
});

test('the same part of the scene is shown in a window of another size', () => {
  const state = stateOf(fragmentOf(currentState()));
  store.camera.value = { ...CAMERA, size: [1000, 600], pixel_spacing: 9 };
  restore(state ?? {});
  expect(store.camera.value?.size).toEqual([1000, 600]);
  expect(store.camera.value?.pixel_spacing).toBeCloseTo(0.25, 12);
});

test('the address contains no name and no voxel value of the study', () => {
  const text = decodeURIComponent(fragmentOf(currentState()));
  for (const secret of ['DOE', 'JANE', '1970', 'renal', 'aorta', '312']) {
    expect(text).not.toContain(secret);
  }
});

describe('invalid parts are ignored', () => {
  test.each([
    '',
    '#',
    '#v1',
    '#v1=',
    '#v1=%',
    '#v1=%7B',
    '#v1=null',
    '#v1=3',
    '#v1="text"',
    '#v2={}',
    '#other=1&x',
    `#v1=${'['.repeat(10_000)}`,
  ])('%s', (fragment) => {
    expect(stateOf(fragment)).toBeNull();
  });

  const camera = {
    center: [0, 0, 0],
    direction: [0, 1, 0],
    up: [0, 0, 1],
    pixel_spacing: 0.5,
    height: 300,
  };

  test('a camera is read as it is written', () => {
    expect(stateOfJson({ camera })).toEqual({ camera });
  });

  test.each([
    ['no camera', null],
    ['a list', [1, 2, 3]],
    ['a spacing as a text', { ...camera, pixel_spacing: '0.5' }],
    ['a height as a list', { ...camera, height: [300] }],
    ['no spacing', { ...camera, pixel_spacing: 0 }],
    ['a huge spacing', { ...camera, pixel_spacing: 1e30 }],
    ['a huge height', { ...camera, height: 1e300 }],
    ['a centre of texts', { ...camera, center: ['0', '0', '0'] }],
    ['a centre far away', { ...camera, center: [1e300, 0, 0] }],
    ['no direction', { ...camera, direction: [0, 0, 0] }],
    ['a direction that is no unit vector', { ...camera, direction: [0, 5, 0] }],
    ['an up along the direction', { ...camera, up: [0, 1, 0] }],
  ])('a camera with %s', (_, broken) => {
    expect(stateOfJson({ camera: broken, layout: 'two' })).toEqual({ layout: 'two' });
  });

  test('numbers beyond all numbers', () => {
    const text = JSON.stringify({ camera }).replace('0.5', '1e999');
    expect(stateOf(`#v1=${encodeURIComponent(text)}`)).toEqual({});
  });

  test.each<Record<string, unknown>>([
    { window: [1, 0] },
    { window: [1, -5] },
    { window: ['1', '2'] },
    { window: [1] },
    { window: [1e300, 1] },
    { window: [0, 1e300] },
    { method: 'other' },
    { method: 7 },
    { layout: 'toString' },
    { layout: ['one'] },
    { inverted: 'yes' },
    { vessel: '1' },
    { place: [] },
    { place: 1e300 },
    { angle: {} },
    { angle: 1e300 },
    { hair: [1, 2] },
    { hair: [1, 2, null] },
    { hair: [1e300, 2, 3] },
    { settings: 'all' },
    { settings: [1] },
    { constructor: 1, __proto__: null },
  ])('%o', (broken) => {
    expect(stateOfJson(broken)).toEqual({});
  });

  test.each<Record<string, unknown>>([
    { step: 'fine' },
    { step: 1e9 },
    { step: null },
    { samples: 1.5 },
    { samples: 1e9 },
    { silhouettes: 1 },
    { context: 'other' },
    { context: 3 },
    { slab: [1e300, 'max'] },
    { slab: 'thick' },
    { focus: [2, -1] },
    { focus: [1e300, 6] },
    { focus: [2] },
    { silhouette_color: [255, 255] },
    { silhouette_color: [255, 0.5, 0] },
    { silhouette_color: [256, 0, 0] },
    { silhouette_color: 'white' },
    { unknown: 1 },
    { __proto__: { step: 1 } },
  ])('the setting %o', (settings) => {
    restore(stateOfJson({ settings }) ?? {});
    expect(store.settings.value).toEqual({});
  });

  test('valid settings are kept if others are invalid', () => {
    restore(stateOfJson({ settings: { step: 1, context: null, samples: 'many', slab: [5, 'max'] } }) ?? {});
    expect(store.settings.value).toEqual({ step: 1, context: null, slab: [5, 'max'] });
  });

  test('a vessel that there is not', () => {
    for (const vessel of [-1, 2, 0.5]) {
      store.pickedVessel.value = 1;
      restore({ vessel });
      expect(store.pickedVessel.value).toBe(1);
    }
  });

  test('no text ever throws', () => {
    const next = random(3);
    const whole = fragmentOf(currentState());
    for (let n = 0; n < 2000; n++) {
      const at = Math.floor(next() * whole.length);
      const broken =
        whole.slice(0, at) + String.fromCharCode(32 + Math.floor(next() * 95)) + whole.slice(at + 1);
      const state = stateOf(broken.slice(0, Math.ceil(next() * broken.length)));
      restore(state ?? {});
    }
    expectNear(store.camera.value?.size ?? [], CAMERA.size);
  });
});
