/** Control points of a transfer function: moved, added and removed, always by rising intensity. */
import type { ControlPoint, SettingValue } from './messages';

/** The engine accepts up to this number of points. */
export const MOST_POINTS = 64;

export type Points = readonly ControlPoint[];

export const isPoints = (value: SettingValue): value is Points => Array.isArray(value);

/** The points with one of them elsewhere: between its neighbours, with an opacity of 0 to 1. */
export function movedPoint(points: Points, at: number, intensity: number, opacity: number): Points {
  const low = points[at - 1]?.[0] ?? Number.NEGATIVE_INFINITY;
  const high = points[at + 1]?.[0] ?? Number.POSITIVE_INFINITY;
  const moved = (point: ControlPoint): ControlPoint => [
    Math.min(Math.max(intensity, low), high),
    point[1],
    Math.min(Math.max(opacity, 0), 1),
  ];
  return points.map((point, n) => (n === at ? moved(point) : point));
}

export function coloured(points: Points, at: number, color: ControlPoint[1]): Points {
  return points.map((point, n) => (n === at ? [point[0], color, point[2]] : point));
}

/** Adds a point with the colour that the function has there; returns the points and its place. */
export function withPoint(points: Points, intensity: number, opacity: number): readonly [Points, number] {
  if (points.length >= MOST_POINTS) {
    return [points, points.length - 1];
  }
  const found = points.findIndex((point) => point[0] > intensity);
  const at = found < 0 ? points.length : found;
  const [before, after] = [points[at - 1] ?? points[at], points[at] ?? points[at - 1]];
  if (!before || !after) {
    return [[[intensity, [255, 255, 255], opacity]], 0];
  }
  const share = after[0] > before[0] ? (intensity - before[0]) / (after[0] - before[0]) : 0;
  const mix = (n: 0 | 1 | 2) => Math.round(before[1][n] + share * (after[1][n] - before[1][n]));
  const added: ControlPoint = [intensity, [mix(0), mix(1), mix(2)], opacity];
  return [[...points.slice(0, at), added, ...points.slice(at)], at];
}

/** The points without one; the last one stays. */
export function withoutPoint(points: Points, at: number): Points {
  return points.length > 1 ? points.filter((_, n) => n !== at) : points;
}

export const hex = (color: ControlPoint[1]): string =>
  `#${color.map((channel) => channel.toString(16).padStart(2, '0')).join('')}`;

export const colorOf = (text: string): ControlPoint[1] => {
  const channel = (from: number) => Number.parseInt(text.slice(from, from + 2), 16);
  return [channel(1), channel(3), channel(5)];
};
