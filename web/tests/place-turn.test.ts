import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { pixelOf } from '../src/core/camera';
import { Failure } from '../src/core/failure';
import type { Answer, Asked, Camera, Question, Report, Vector } from '../src/core/messages';
import { dragTurning, windowBack } from '../src/state/actions';
import { destination } from '../src/state/flight';
import {
  diameterAfter,
  dragPlaceTurn,
  followPlaceTurn,
  type PlaceTurn,
  placeTurn,
  sweptTo,
  togglePlaceTurn,
  turnTo,
} from '../src/state/place-turn';
import * as store from '../src/state/store';
import { tool } from '../src/state/tool';
import { connect } from '../src/worker/engine';
import { CAMERA, expectNear } from './helpers';

const FIRST: Camera = { ...CAMERA, center: [5, 6, 7], pixel_spacing: 0.1 };
/** Diameters per degree: 10 mm at 0°, 1 mm less every 10°, 2 mm at 80° and 90°; null at 100°. */
const DIAMETERS = Array.from({ length: 180 }, (_, n) =>
  n === 100 ? null : 10 - Math.floor(Math.min(n, 179 - n) / 10),
);
const TURN: PlaceTurn = {
  line: 4,
  at: 20,
  first: FIRST,
  diameters: DIAMETERS,
  angle: 0,
  least: 10,
  largest: 10,
};

const shown = (line: number): Report => ({
  volume: {
    size: [1, 1, 1],
    world_from_index: [],
    corners: [],
    smallest_side: 1,
    pixel_side: 0.25,
    scan: '',
    doubt: null,
    notes: [],
  },
  vessels: [{ line, name: '', length: 50, has_radius: true }],
  windows: null,
});

let questions: unknown[] = [];
let answer: () => Promise<unknown>;
const engine: Asked = {
  ask: <N extends Question>(name: N, message: unknown) => {
    questions.push([name, message]);
    return answer() as Promise<Answer<N>>;
  },
};
connect(engine);

let end: () => void;
beforeEach(() => {
  questions = [];
  answer = () => Promise.resolve({ camera: FIRST, diameters: DIAMETERS });
  // The user prefers reduced motion, so each view appears at once.
  vi.stubGlobal('window', { matchMedia: () => ({ matches: true }) });
  placeTurn.value = null;
  tool.value = 'look';
  store.problem.value = null;
  store.camera.value = CAMERA;
  store.report.value = shown(4);
  store.pickedVessel.value = 0;
  store.pickedPlace.value = 20;
  end = followPlaceTurn();
});
afterEach(() => {
  end();
  vi.unstubAllGlobals();
});

describe('the diameters of a turn', () => {
  test('repeat after half a circle', () => {
    for (const degrees of [0, 37, 80, 179]) {
      expect(diameterAfter(TURN, degrees)).toBe(DIAMETERS[degrees]);
      expect(diameterAfter(TURN, degrees - 180)).toBe(DIAMETERS[degrees]);
    }
  });

  test('so far include those of all cuts passed in the shorter direction', () => {
    const there = sweptTo(TURN, 45);
    expect([there.angle, there.least, there.largest]).toEqual([45, 6, 10]);
    const back = sweptTo(there, 10);
    expect([back.least, back.largest]).toEqual([6, 10]);
    const around = sweptTo({ ...TURN, angle: 170, least: 10, largest: 10 }, -170);
    expect([around.angle, around.least]).toEqual([-170, 9]);
    expect(sweptTo(TURN, 400).angle).toBe(40);
  });

  test('that are not visible are ignored', () => {
    const none = { ...TURN, diameters: [null, 3], least: null, largest: null };
    expect(sweptTo(none, 0).least).toBeNull();
    expect(sweptTo(none, 1)).toMatchObject({ angle: 1, least: 3, largest: 3 });
  });
});

describe('a turn', () => {
  test('is about the place of the section, and is requested once', async () => {
    await togglePlaceTurn();
    expect(questions).toEqual([['turn_about', { vessel: 0, at: 20, size: CAMERA.size }]]);
    expect(placeTurn.value).toEqual({ ...TURN, least: 10, largest: 10 });
    expect(store.camera.value).toEqual(FIRST);
    await togglePlaceTurn();
    expect(placeTurn.value).toBeNull();
    expect(store.camera.value).toEqual(FIRST);
  });

  test('keeps the place at its pixel, also after the view was moved', async () => {
    await togglePlaceTurn();
    store.camera.value = { ...FIRST, center: [6, 6, 8], pixel_spacing: 0.2 };
    const before = pixelOf(store.camera.value, FIRST.center);
    turnTo(90);
    const camera = store.camera.value;
    expectNear(pixelOf(camera, FIRST.center), before, 9);
    // The viewer moves from the front to the left of the patient, and then looks to the right, as in the engine.
    expectNear(camera.direction, [-1, 0, 0], 12);
    expect(placeTurn.value).toMatchObject({ angle: 90, least: 2, largest: 10 });
  });

  test('follows a drag in integer degrees, and Escape undoes the drag', async () => {
    await togglePlaceTurn();
    const drag = windowBack();
    drag.begin();
    dragPlaceTurn(1, 300);
    expect(placeTurn.value?.angle).toBe(0);
    dragPlaceTurn(1, 300);
    expect(placeTurn.value?.angle).toBe(-1);
    dragTurning('rotate', [-50, 30], null);
    expect(placeTurn.value?.angle).toBe(28);
    drag.putBack();
    expect(placeTurn.value).toEqual(TURN);
    expect(store.camera.value).toEqual(FIRST);
  });

  test('returns to its first view on Escape if the drag began before this view was reached', async () => {
    vi.stubGlobal('window', { matchMedia: () => ({ matches: false }) });
    const turn = { camera: FIRST, diameters: DIAMETERS };
    answer = () => (questions.length > 1 ? new Promise(() => undefined) : Promise.resolve(turn));
    await togglePlaceTurn();
    expect([store.camera.value, destination.value]).toEqual([CAMERA, FIRST]);
    const drag = windowBack();
    drag.begin();
    dragPlaceTurn(50, 300);
    expect(destination.value).toBeNull();
    expect(placeTurn.value?.angle).toBeLessThan(-28);
    drag.putBack();
    expect([store.camera.value, placeTurn.value]).toEqual([FIRST, TURN]);
  });

  const turned = (axis: Vector) => ({ ...FIRST, direction: axis, up: [0, 0, 1] as Vector });
  test.each([
    ['another view', () => (store.camera.value = turned([1, 0, 0]))],
    ['another vessel', () => (store.report.value = shown(5))],
    ['no study', () => (store.report.value = null)],
    ['a tool', () => (tool.value = 'trace')],
  ])('ends with %s', async (_, change) => {
    await togglePlaceTurn();
    expect(placeTurn.value).not.toBeNull();
    change();
    expect(placeTurn.value).toBeNull();
  });

  test('does not begin if the engine rejects it, and the page says why', async () => {
    const failure = new Failure('measuring', 'radius', 'none', 'one');
    answer = () => Promise.reject(failure);
    await togglePlaceTurn();
    expect(placeTurn.value).toBeNull();
    expect(store.problem.value?.subject).toBe('radius');
  });

  test('does not begin on a vessel that is no longer picked, nor without a vessel', async () => {
    const asked = togglePlaceTurn();
    store.report.value = shown(5);
    await asked;
    expect(placeTurn.value).toBeNull();
    store.pickedVessel.value = null;
    await togglePlaceTurn();
    expect(questions).toHaveLength(1);
  });
});
