/** Makes scans of a curved vessel at two times: its stenosis has grown, and the patient lies elsewhere. */
import { fileOf, type MadeFile } from './controls';
import { nrrd } from './nrrd';

type Point = readonly [number, number, number];

/** Voxels along the axes, and their side (mm); the middle of the volume lies at the shift. */
const COUNTS = [54, 46, 112] as const;
const SIDE = 0.6;
/** Diameter of the vessel (mm); middle of the stenosis along z, and half of its length (mm). */
const DIAMETER = 6;
const AT = 4;
const REACH = 9;

export interface Time {
  readonly narrowest: number;
  readonly shift: Point;
}

export const EARLIER: Time = { narrowest: 5, shift: [0, 0, 0] };
export const LATER: Time = { narrowest: 3.2, shift: [30, -12, 200] };

/** A curve without symmetry, so that its shape determines which places belong together. */
export const curve = (z: number): Point => [6 * Math.sin(z / 9) + 0.004 * z ** 2, 5 * Math.cos(z / 7), z];

function radiusAt(z: number, narrowest: number): number {
  const away = Math.min(Math.abs(z - AT) / REACH, 1);
  return (DIAMETER - (DIAMETER - narrowest) * (0.5 + 0.5 * Math.cos(Math.PI * away))) / 2;
}

/** Value (HU) at a position from the middle of the volume (mm): lumen, or soft tissue. */
function valueAt([x, y, z]: Point, narrowest: number): number {
  const [a, b] = [curve(z - 0.05), curve(z + 0.05)];
  const [u, v] = [x - curve(z)[0], y - curve(z)[1]];
  const [du, dv] = [(b[0] - a[0]) / 0.1, (b[1] - a[1]) / 0.1];
  // The section of a slanted tube with a plane of constant z is longer along its slant.
  const along = (u * du + v * dv) ** 2 / (1 + du ** 2 + dv ** 2);
  const depth = radiusAt(z, narrowest) - Math.sqrt(Math.max(u ** 2 + v ** 2 - along, 0));
  return 40 + 310 * Math.min(Math.max(0.5 + depth / SIDE, 0), 1);
}

export const scanAt = (name: string, { narrowest, shift }: Time): MadeFile =>
  nrrd(name, { counts: COUNTS, side: SIDE, middle: shift }, (...place) => valueAt(place, narrowest));

export function lineAt(name: string, { shift }: Time): MadeFile {
  const places = Array.from({ length: 113 }, (_, n) => curve(-28 + n / 2));
  const moved = places.map((point) => point.map((part, axis) => part + (shift[axis] ?? 0)));
  return markups(name, moved, DIAMETER / 2);
}

/** A centerline as a 3D Slicer markups file, which states its coordinates. */
export function markups(name: string, places: readonly (readonly number[])[], radius: number): MadeFile {
  const controlPoints = places.map((position, n) => ({ id: String(n + 1), position }));
  const controlPointValues = places.map(() => radius);
  const measurements = [{ name: 'Radius', enabled: true, units: 'mm', controlPointValues }];
  const curveOf = {
    type: 'Curve',
    coordinateSystem: 'LPS',
    coordinateUnits: 'mm',
    controlPoints,
    measurements,
  };
  return fileOf(name, Buffer.from(JSON.stringify({ markups: [curveOf] })));
}
