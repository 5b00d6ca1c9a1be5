/** Draws the key image of a finding: the straightened vessel with its marks, above the sections at these marks. */

import { Failure } from '../core/failure';
import { SECTION_PIXELS as SIDE } from '../core/generated/tables';
import type { Pair, Profile, ReportPlace } from '../core/messages';
import { type Finding, markedVessel } from '../measure/findings';
import { colorOfPlace } from '../measure/PlaceHandles';
import { nearestSection } from '../measure/sections';
import { spread } from '../measure/words';
import { profileOfLine } from '../state/profiles';
import { engine } from '../worker/engine';
import { canvasOf, sectionPair, straightenedCanvas } from './report-pictures';
import { fittingSize } from './wrapping';

const COLUMNS = 3;
const WIDTH = COLUMNS * SIDE;
/** Largest height of the vessel picture, and line height of text (pixels). */
const MAX_VESSEL_HEIGHT = 260;
const LINE = 36;
/** Largest size of letters (pixels), which the page shows at about half of it. */
const LETTERS = 28;
/** The label of a section: its name, and below it the diameter. */
const LABEL = 2 * LINE;

export async function keyImage(finding: Finding): Promise<HTMLCanvasElement> {
  const profile = await profileOfLine(finding.line);
  const plan = await engine.ask('report_plan', markedVessel(finding));
  const places = plan.places.filter((place) => !place.is_suggestion);
  const strip = await straightenedCanvas(finding.vessel, plan);
  const scale = Math.min(WIDTH / strip.width, MAX_VESSEL_HEIGHT / strip.height);
  const [width, height] = [strip.width * scale, strip.height * scale];
  const rows = Math.ceil(places.length / COLUMNS);
  const [canvas, context] = canvasOf(WIDTH, Math.ceil(LINE + height + rows * (SIDE + LABEL)));
  context.fillStyle = '#000';
  context.fillRect(0, 0, canvas.width, canvas.height);
  words(context, finding.name || `vessel ${finding.vessel + 1}`, [8, LINE - 9], '#fff');
  context.drawImage(strip, 0, LINE, width, height);
  for (const place of places) {
    line(context, { place, x: (place.at / plan.spacing + 0.5) * scale, height });
  }
  for (const [number, place] of places.entries()) {
    const pair = await sectionPair({ ...finding, spacing: plan.section_spacing }, profile, place.at);
    const [x, y] = [(number % COLUMNS) * SIDE, LINE + height + Math.floor(number / COLUMNS) * (SIDE + LABEL)];
    for (const [n, label] of [place.name, diameterAt(profile, place.at)].entries()) {
      words(context, label, [x + 8, y + (n + 1) * LINE - 9], colorOfPlace(place), SIDE - 16);
    }
    context.drawImage(pair, 0, 0, SIDE, SIDE, x, y + LABEL, SIDE, SIDE);
  }
  return canvas;
}

export async function keyPicture(finding: Finding): Promise<Blob> {
  const canvas = await keyImage(finding);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (!blob) {
    throw new Failure('picture', 'key image', 'no PNG', 'a browser that can write PNG', 'close other pages');
  }
  return blob;
}

function diameterAt(profile: Profile, at: number): string {
  const number = nearestSection(profile, at);
  return spread(profile.diameter[number] ?? null, profile.uncertainty[number] ?? null);
}

/** Draws a line of text, in a smaller font if it would be too wide. */
function words(
  context: CanvasRenderingContext2D,
  text: string,
  [x, y]: Pair,
  color: string,
  widest = WIDTH - 16,
): void {
  context.font = `600 ${LETTERS}px system-ui, sans-serif`;
  const wide = context.measureText(text).width;
  if (wide > widest) {
    context.font = `600 ${fittingSize(LETTERS, wide, widest)}px system-ui, sans-serif`;
  }
  context.fillStyle = color;
  context.fillText(text, x, y, widest);
}

function line(
  context: CanvasRenderingContext2D,
  { place, x, height }: { readonly place: ReportPlace; readonly x: number; readonly height: number },
): void {
  context.strokeStyle = colorOfPlace(place);
  context.lineWidth = 2;
  context.beginPath();
  for (const [from, to] of [
    [0, 0.2],
    [0.8, 1],
  ] as const) {
    context.moveTo(x, LINE + from * height);
    context.lineTo(x, LINE + to * height);
  }
  context.stroke();
}
