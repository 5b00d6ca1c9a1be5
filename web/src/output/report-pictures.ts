/** Draws the pictures of the report and of its findings. */

import { pixelOf } from '../core/camera';
import { Failure } from '../core/failure';
import { SECTION_PIXELS as SIDE } from '../core/generated/tables';
import type {
  Cpr,
  LineId,
  Pair,
  Picture,
  PictureLabels,
  Plane,
  Profile,
  ReportPlace,
  ReportPlan,
  ReportStrip,
} from '../core/messages';
import { pixelOn } from '../core/planes';
import { lyingPicture } from '../measure/layout';
import { colorOfPlace } from '../measure/PlaceHandles';
import { contours, isByHand } from '../measure/SectionMarks';
import { centerAt, nearestSection } from '../measure/sections';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { composed } from './pictures';

export function canvasOf(width: number, height: number): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d');
  if (!context) {
    throw new Failure(
      'picture',
      'report',
      'no canvas',
      'a browser that can create a canvas',
      'close other pages',
    );
  }
  return [canvas, context];
}

const pixelsOf = ({ size, bytes }: Picture): ImageData => new ImageData(bytes, size[0], size[1]);

export const pngOf = (canvas: HTMLCanvasElement): string => canvas.toDataURL('image/png').split(',')[1] ?? '';

export async function viewPicture(profile: Profile, places: readonly ReportPlace[]): Promise<string> {
  const camera = store.camera.value;
  const canvas = await composed('labels');
  const context = canvas.getContext('2d');
  if (camera && context) {
    const density = canvas.height / camera.size[1];
    for (const place of places) {
      const center = centerAt(profile, place.at);
      if (center) {
        const [x, y] = pixelOf(camera, center);
        context.beginPath();
        context.arc((x + 0.5) * density, (y + 0.5) * density, 7 * density, 0, 2 * Math.PI);
        context.lineWidth = 2 * density;
        context.strokeStyle = colorOfPlace(place);
        context.setLineDash(place.is_suggestion ? [3 * density, 3 * density] : []);
        context.stroke();
      }
    }
  }
  return pngOf(canvas);
}

export async function straightened(vessel: number, plan: ReportPlan): Promise<ReportStrip> {
  const canvas = await straightenedCanvas(vessel, plan);
  return { picture: pngOf(canvas), size: [canvas.width, canvas.height], spacing: plan.spacing };
}

export async function straightenedCanvas(
  vessel: number,
  { width, spacing }: Pick<ReportPlan, 'width' | 'spacing'>,
): Promise<HTMLCanvasElement> {
  const cpr: Cpr = {
    vessel,
    angle: store.cprAngle.value,
    width,
    pixel_spacing: spacing,
    feature: null,
    roll: null,
  };
  const picture = lyingPicture(await engine.ask('straightened', { cpr: cpr, window: store.window_.value }));
  const [canvas, context] = canvasOf(...picture.size);
  context.putImageData(pixelsOf(picture), 0, 0);
  return canvas;
}

/** Two pictures of a section side by side: on the left with its contour, on the right without. */
export async function sectionPair(
  { vessel, line, spacing }: { readonly vessel: number; readonly line: LineId; readonly spacing: number },
  profile: Profile,
  at: number,
): Promise<HTMLCanvasElement> {
  const number = nearestSection(profile, at);
  const plane = await planeOf(vessel, profile, { number, spacing });
  const [picture, section] = await Promise.all([
    engine.ask('slice', { plane: plane, window: store.window_.value }),
    engine.ask('measured_section', { line, at }),
  ]);
  const [canvas, context] = canvasOf(2 * SIDE, SIDE);
  const pixels = pixelsOf(picture);
  context.putImageData(pixels, 0, 0);
  context.putImageData(pixels, SIDE, 0);
  context.lineWidth = 2.5;
  for (const { points, color, dashes } of contours(section, profile)) {
    context.beginPath();
    for (const [x, y] of points.map((point) => pixelOn(plane, point))) {
      context.lineTo(x + 0.5, y + 0.5);
    }
    context.closePath();
    context.setLineDash([...dashes]);
    context.strokeStyle = color;
    context.stroke();
  }
  context.setLineDash([]);
  if (isByHand(profile, number)) {
    write(context, 'contour by hand', [6, 30]);
  }
  const { bar, letters } = await engine.ask('labels', { ...plane, width: SIDE });
  const { spacing: hasSpacing, orientation } = store.states.value;
  for (const left of [0, SIDE]) {
    drawBar(context, hasSpacing ? bar : null, left);
    drawLetters(context, orientation ? letters : null, left);
  }
  return canvas;
}

async function planeOf(
  vessel: number,
  profile: Profile,
  { number, spacing }: { readonly number: number; readonly spacing: number },
): Promise<Plane> {
  const [middle, right, down] = await engine.ask('across', { vessel, at: profile.arc_length[number] ?? 0 });
  return {
    center: profile.center[number] ?? middle,
    right,
    down,
    size: [SIDE, SIDE],
    pixel_spacing: spacing,
  };
}

function drawBar(context: CanvasRenderingContext2D, bar: PictureLabels['bar'], left: number): void {
  if (bar) {
    context.fillStyle = '#000000';
    context.fillRect(left + 7, SIDE - 11, bar.pixels + 2, 4);
    context.fillStyle = '#ffffff';
    context.fillRect(left + 8, SIDE - 10, bar.pixels, 2);
    write(context, bar.words, [left + 8, SIDE - 15]);
  }
}

type Letters = PictureLabels['letters'];

function drawLetters(context: CanvasRenderingContext2D, letters: Letters | null, left: number): void {
  if (letters) {
    write(context, letters.top, [left + SIDE / 2, 14]);
    write(context, letters.bottom, [left + SIDE / 2, SIDE - 6]);
    write(context, letters.left, [left + 6, SIDE / 2]);
    write(context, letters.right, [left + SIDE - 6, SIDE / 2], 'right');
  }
}

/** White words with a black rim, which stay readable over bright tissue. */
function write(
  context: CanvasRenderingContext2D,
  words: string,
  [x, y]: Pair,
  align: CanvasTextAlign = 'left',
): void {
  context.font = '600 13px system-ui, sans-serif';
  context.textAlign = align;
  context.lineWidth = 3;
  context.strokeStyle = '#000000';
  context.strokeText(words, x, y);
  context.fillStyle = '#ffffff';
  context.fillText(words, x, y);
}
