/** Thumbnails for the choice of a series: its middle slice, with 64 pixels on the longer side. */
import { Failure, type SeriesChoice, type Thumbnail } from '../../core/failure';
import type { Numbers } from '../numbers';
import { shapeOf } from './frames';
import type { ExaminedFile, Image } from './headers';
import { PixelReader } from './pixels';

const SIDE = 64;
const CLIPPED_SHARE = 0.02;

export async function withThumbnails(failure: unknown, files: readonly ExaminedFile[]): Promise<unknown> {
  if (!(failure instanceof Failure) || failure.series.length === 0) {
    return failure;
  }
  const { kind, subject, found, expected, advice, more } = failure;
  const series: SeriesChoice[] = [];
  for (const choice of failure.series) {
    const thumbnail = await thumbnailOf(imagesOf(choice, files)).catch(() => null);
    series.push(thumbnail ? { ...choice, thumbnail } : choice);
  }
  return new Failure(kind, subject, found, expected, advice, { ...more, series });
}

function imagesOf({ uid }: SeriesChoice, files: readonly ExaminedFile[]): readonly Image[] {
  return files.flatMap(({ image }) => (image?.header.attributes.SeriesInstanceUID === uid ? [image] : []));
}

/** Thumbnail of the middle slice by position; null if the slice has no pixels. */
async function thumbnailOf(images: readonly Image[]): Promise<Thumbnail | null> {
  const inOrder = images.filter(({ pixels }) => pixels).toSorted((a, b) => placeOf(a) - placeOf(b));
  const middle = inOrder[Math.floor(inOrder.length / 2)];
  if (!middle) {
    return null;
  }
  const { columns, rows, frameCount } = shapeOf(middle);
  const values = await new PixelReader().read(middle, Math.floor(frameCount / 2));
  return pictureOf(values, [columns, rows]);
}

/** Position of an image along the slice normal (mm), or its instance number if the position is unknown. */
function placeOf({ header: { attributes } }: Image): number {
  const numbers = (keyword: string) => [attributes[keyword] ?? []].flat().map(Number);
  const [at, axes] = [numbers('ImagePositionPatient'), numbers('ImageOrientationPatient')];
  const [a = 1, b = 0, c = 0, d = 0, e = 1, f = 0] = axes;
  const normal = [b * f - c * e, c * d - a * f, a * e - b * d];
  const place = normal.reduce((sum, part, axis) => sum + part * (at[axis] ?? Number.NaN), 0);
  return Number.isFinite(place) ? place : Number(attributes.InstanceNumber ?? 0);
}

export function pictureOf(values: Numbers, [columns, rows]: readonly [number, number]): Thumbnail {
  const step = Math.max(columns, rows) / SIDE;
  const [width, height] = [Math.max(1, Math.round(columns / step)), Math.max(1, Math.round(rows / step))];
  const at = (n: number) => {
    const column = Math.min(columns - 1, Math.floor(((n % width) + 0.5) * step));
    const row = Math.min(rows - 1, Math.floor((Math.floor(n / width) + 0.5) * step));
    return Number(values[row * columns + column]);
  };
  const taken = Float64Array.from({ length: width * height }, (_, n) => at(n));
  const sorted = taken.toSorted();
  const end = (share: number) => sorted[Math.round(share * (sorted.length - 1))] ?? 0;
  const [low, high] = [end(CLIPPED_SHARE), end(1 - CLIPPED_SHARE)];
  const grey = taken.map((value) => (255 * (value - low)) / Math.max(high - low, 1e-9));
  return { width, height, grey: [...Uint8ClampedArray.from(grey)] };
}
