/** Saves pictures of the turning view, with or without labels. */

import { rightOf } from '../core/camera';
import { Failure } from '../core/failure';
import type { Camera, Legend, PictureLabels } from '../core/messages';
import { negate } from '../core/vectors';
import { rimLegend } from '../measure/rim';
import { showMessage } from '../state/message';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { sideOf, studyFileName } from './file-names';

export async function composed(labels: 'labels' | 'plain'): Promise<HTMLCanvasElement> {
  const shown = document.querySelector<HTMLCanvasElement>('[data-testid=turning] canvas.picture');
  const camera = store.camera.value;
  if (!shown || !camera || shown.width === 0) {
    throw new Failure('picture', 'picture', 'no view', 'an open scan');
  }
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [shown.width, shown.height];
  const context = canvas.getContext('2d');
  if (!context) {
    throw new Failure(
      'picture',
      'picture',
      'no canvas',
      'a browser that can create a canvas',
      'close other pages',
    );
  }
  context.filter = store.isInverted.value ? 'invert(1)' : 'none';
  context.drawImage(shown, 0, 0);
  context.filter = 'none';
  if (labels === 'labels') {
    // On high-resolution screens the picture has several pixels per CSS pixel.
    const density = canvas.height / camera.size[1];
    drawLabels(context, await labelsOf(camera, density), density);
    const legend = await rimLegend().catch(() => null);
    if (legend) {
      drawLegend(context, legend, density);
    }
  }
  return canvas;
}

const labelsOf = (camera: Camera, density: number): Promise<PictureLabels> =>
  engine.ask('labels', {
    right: rightOf(camera),
    down: negate(camera.up),
    width: camera.size[0] * density,
    pixel_spacing: camera.pixel_spacing / density,
  });

/** Draws orientation letters and scale bar, if orientation and spacing are known. */
function drawLabels(
  context: CanvasRenderingContext2D,
  { letters, bar }: PictureLabels,
  density: number,
): void {
  const [width, height] = [context.canvas.width, context.canvas.height];
  context.font = `600 ${14 * density}px system-ui, sans-serif`;
  context.textBaseline = 'middle';
  context.lineJoin = 'round';
  const edge = 14 * density;
  const places: readonly (readonly [string, number, number])[] = [
    [letters.top, width / 2, edge],
    [letters.bottom, width / 2, height - edge],
    [letters.left, edge, height / 2],
    [letters.right, width - edge, height / 2],
  ];
  const { spacing, orientation } = store.states.value;
  for (const [word, x, y] of orientation ? places : []) {
    outlined(context, word, x, y, 'center');
  }
  if (spacing && bar) {
    context.fillStyle = '#fff';
    context.fillRect(edge, height - edge, bar.pixels, 2 * density);
    outlined(context, bar.words, edge + bar.pixels / 2, height - 2 * edge, 'center');
  }
}

/** Draws the colours of a rim at the right edge, with the values at both ends. */
function drawLegend(context: CanvasRenderingContext2D, legend: Legend, density: number): void {
  const [width, height] = [context.canvas.width, context.canvas.height];
  const [edge, top, bottom] = [14 * density, height / 6, height / 3];
  const colours = context.createLinearGradient(0, bottom, 0, top);
  for (const [n, [red, green, blue]] of legend.colours.entries()) {
    colours.addColorStop(n / (legend.colours.length - 1), `rgb(${red} ${green} ${blue})`);
  }
  context.fillStyle = colours;
  context.fillRect(width - 2 * edge, top, edge, bottom - top);
  const right = width - edge;
  outlined(context, legend.words, right, top - 2 * edge, 'right');
  outlined(context, `${legend.high} ${legend.unit}`, right, top - 0.7 * edge, 'right');
  outlined(context, `${legend.low} ${legend.unit}`, right, bottom + 0.7 * edge, 'right');
}

function outlined(
  context: CanvasRenderingContext2D,
  text: string,
  x: number,
  y: number,
  align: CanvasTextAlign,
): void {
  context.textAlign = align;
  context.strokeStyle = '#000';
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = '#fff';
  context.fillText(text, x, y);
}

export async function savePng(labels: 'labels' | 'plain'): Promise<void> {
  const canvas = await composed(labels);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (blob) {
    saveAs(blob, studyFileName({ content: 'picture', side: sideOfView(), ending: 'png' }));
  }
}

/** The side from which the view shows the patient; null if the orientation is unknown. */
export function sideOfView(): string | null {
  const camera = store.camera.value;
  return camera && store.states.value.orientation ? sideOf(camera.direction) : null;
}

export function saveAs(blob: Blob, name: string, remark = ''): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  showMessage(`Saved as ${name}${remark ? `. ${remark}` : ''}`);
  window.setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
