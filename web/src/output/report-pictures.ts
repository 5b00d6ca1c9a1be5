/** The pictures of a report, drawn on canvases. */
import { pixelOf } from '../core/camera';
import { Failure } from '../core/failure';
import type { Profile } from '../core/measuring';
import type { Cpr, LineId, Pair, Picture, PictureLabels, Plane } from '../core/messages';
import { engine } from '../core/shared';
import { type Lying, lyingPicture } from '../measure/lying';
import type { Place } from '../measure/marks';
import { COLORS } from '../measure/PlaceHandles';
import { CONTOUR } from '../measure/SectionMarks';
import { centerAt, fittingSide, nearestSection } from '../measure/sections';
import * as store from '../state/store';
import { pixelOn } from '../views/planes';
import { composed } from './pictures';

/** The side of a picture of a section (pixels). */
const SIDE = 300;

function canvasOf(width: number, height: number): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d');
  if (!context) {
    throw new Failure('picture', 'report', 'no canvas', 'a browser that can draw', 'close other pages');
  }
  return [canvas, context];
}

const pixelsOf = ({ size, bytes }: Picture): ImageData => new ImageData(bytes, size[0], size[1]);

/** The turning view as it is shown, with its labels and with the marked places. */
export async function viewPicture(profile: Profile, places: readonly Place[]): Promise<string> {
  const camera = store.camera.value;
  const canvas = await composed('labels');
  const context = canvas.getContext('2d');
  if (camera && context) {
    const density = canvas.height / camera.size[1];
    for (const { kind, at, isSuggestion } of places) {
      const center = centerAt(profile, at);
      if (center && (kind === 'place' || kind === 'reference')) {
        const [x, y] = pixelOf(camera, center);
        context.beginPath();
        context.arc((x + 0.5) * density, (y + 0.5) * density, 7 * density, 0, 2 * Math.PI);
        context.lineWidth = 2 * density;
        context.strokeStyle = COLORS[kind];
        context.setLineDash(isSuggestion ? [3 * density, 3 * density] : []);
        context.stroke();
      }
    }
  }
  return canvas.toDataURL('image/png');
}

/** The lying vessel, and how many pixels it has. */
export async function lyingData(
  vessel: number,
  { width, spacing }: Lying,
): Promise<{ data: string; pixels: Pair }> {
  const cpr: Cpr = { vessel, angle: store.cprAngle.value, width, pixel_spacing: spacing, feature: null };
  const picture = lyingPicture(await engine.straightened(cpr, store.window_.value));
  const [canvas, context] = canvasOf(...picture.size);
  context.putImageData(pixelsOf(picture), 0, 0);
  return { data: canvas.toDataURL('image/png'), pixels: picture.size };
}

/** The section at a place, with its contour on the left and without it on the right. */
export async function sectionPair(
  { vessel, line }: { readonly vessel: number; readonly line: LineId },
  profile: Profile,
  at: number,
): Promise<string> {
  const number = nearestSection(profile, at);
  const plane = await planeOf(vessel, profile, number);
  const [picture, section] = await Promise.all([
    engine.slice(plane, store.window_.value),
    engine.measuring.section(line, at),
  ]);
  const [canvas, context] = canvasOf(2 * SIDE, SIDE);
  const pixels = pixelsOf(picture);
  context.putImageData(pixels, 0, 0);
  context.putImageData(pixels, SIDE, 0);
  const points = section.contour.map((point) => pixelOn(plane, point));
  context.beginPath();
  for (const [x, y] of points) {
    context.lineTo(x + 0.5, y + 0.5);
  }
  context.closePath();
  context.lineWidth = 2.5;
  context.strokeStyle = profile.counts[number] ? CONTOUR.counts : CONTOUR.leftOut;
  context.stroke();
  if (store.states.value.spacing) {
    const { bar } = await engine.labels({ ...plane, width: SIDE });
    drawBar(context, bar);
  }
  return canvas.toDataURL('image/png');
}

/** The plane that was measured, with the lumen in its middle. */
async function planeOf(vessel: number, profile: Profile, number: number): Promise<Plane> {
  const [middle, right, down] = await engine.across(vessel, profile.arc_length[number] ?? 0);
  return {
    center: profile.center[number] ?? middle,
    right,
    down,
    size: [SIDE, SIDE],
    pixel_spacing: fittingSide(profile) / (SIDE - 1),
  };
}

/** The scale bar in both pictures. */
function drawBar(context: CanvasRenderingContext2D, bar: PictureLabels['bar']): void {
  if (!bar) {
    return;
  }
  context.fillStyle = '#ffffff';
  context.font = '600 13px system-ui, sans-serif';
  for (const left of [8, SIDE + 8]) {
    context.fillRect(left, SIDE - 10, bar.pixels, 2);
    context.fillText(bar.words, left, SIDE - 15);
  }
}
