/** The view that pages with two scans exchange. */
import { expect, test } from 'vitest';
import type { Seen } from '../src/core/linked';
import type { Camera } from '../src/core/messages';
import { STANDARD } from '../src/core/planes';
import { followSeen, scanNow, seenNow, setOperated, takeSeen } from '../src/state/linked-view';
import * as store from '../src/state/store';

const CAMERA: Camera = {
  center: [1, 2, 3],
  direction: [0, 1, 0],
  up: [0, 0, 1],
  size: [300, 200],
  pixel_spacing: 0.5,
};

test('only the page that the user operates tells its view', () => {
  store.setCamera(CAMERA);
  const told: Seen[] = [];
  setOperated(true);
  const end = followSeen((seen) => told.push(seen));
  expect(Object.assign({}, ...told)).toEqual(seenNow());
  told.length = 0;
  takeSeen({ cameras: { ...CAMERA, center: [9, 9, 9] }, windows: [40, 400] });
  expect(told).toEqual([]);
  setOperated(true);
  store.setCamera(CAMERA);
  expect(told).toEqual([{ cameras: CAMERA }]);
  end();
  store.setCamera({ ...CAMERA, center: [0, 0, 0] });
  expect(told.length).toBe(1);
});

test('a taken camera keeps the size of the pane, and the size of a pixel in mm', () => {
  store.setCamera(CAMERA);
  takeSeen({ cameras: { ...CAMERA, size: [500, 700], pixel_spacing: 0.2, center: [7, 7, 7] } });
  expect(store.camera.value).toEqual({ ...CAMERA, pixel_spacing: 0.2, center: [7, 7, 7] });
  expect(scanNow()).toBeNull();
});

test('planes that another page sends are the standard ones again, and an unknown layout changes nothing', () => {
  takeSeen({ slices: structuredClone({ ...STANDARD, slab: [20, 'max'] as const }), layouts: 'four' });
  expect(store.slices.value.axial).toBe(STANDARD.axial);
  expect(store.slices.value.slab).toEqual([20, 'max']);
  takeSeen({ slices: structuredClone(STANDARD), layouts: 'nine' });
  expect(store.slices.value).toBe(STANDARD);
  expect(store.layout.value).toBe('four');
});
