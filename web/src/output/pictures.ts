/** Pictures of the turning view as files: with or without labels. */
import { rightOf } from '../core/camera';
import { Failure } from '../core/failure';
import type { Camera } from '../core/messages';
import { negate } from '../core/vectors';
import * as store from '../state/store';
import { tell } from '../state/telling';
import { barLength, lettersOf } from '../views/letters';

/** The canvas of the turning view as it is shown, with its labels where they are wanted. */
export function composed(labels: 'labels' | 'plain'): HTMLCanvasElement {
  const shown = document.querySelector<HTMLCanvasElement>('[data-testid=turning] canvas.picture');
  const camera = store.camera.value;
  if (!shown || !camera || shown.width === 0) {
    throw new Failure('picture', 'picture', 'no view', 'a scan that is open');
  }
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [shown.width, shown.height];
  const context = canvas.getContext('2d');
  if (!context) {
    throw new Failure('picture', 'picture', 'no canvas', 'a browser that can draw', 'close other pages');
  }
  context.filter = store.isInverted.value ? 'invert(1)' : 'none';
  context.drawImage(shown, 0, 0);
  context.filter = 'none';
  if (labels === 'labels') {
    drawLabels(context, camera, canvas.height / camera.size[1]);
  }
  return canvas;
}

/** Letters, scale bar and the words that it is no medical device's picture. */
function drawLabels(context: CanvasRenderingContext2D, camera: Camera, density: number): void {
  const [width, height] = [context.canvas.width, context.canvas.height];
  const right = rightOf(camera);
  context.font = `600 ${14 * density}px system-ui, sans-serif`;
  context.textBaseline = 'middle';
  context.lineJoin = 'round';
  const edge = 14 * density;
  const places: readonly (readonly [string, number, number])[] = [
    [lettersOf(camera.up), width / 2, edge],
    [lettersOf(negate(camera.up)), width / 2, height - edge],
    [lettersOf(negate(right)), edge, height / 2],
    [lettersOf(right), width - edge, height / 2],
  ];
  const { spacing, orientation } = store.states.value;
  for (const [letters, x, y] of orientation ? places : []) {
    outlined(context, letters, x, y, 'center');
  }
  if (!spacing) {
    return;
  }
  const bar = barLength(camera.size[0] * 0.3 * camera.pixel_spacing);
  const length = (bar / camera.pixel_spacing) * density;
  context.fillStyle = '#fff';
  context.fillRect(edge, height - edge, length, 2 * density);
  outlined(
    context,
    bar < 10 ? `${bar} mm` : `${bar / 10} cm`,
    edge + length / 2,
    height - 2 * edge,
    'center',
  );
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

/** Saves a picture as a PNG. */
export async function savePng(labels: 'labels' | 'plain'): Promise<void> {
  const canvas = composed(labels);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (blob) {
    saveAs(blob, 'lumencut.png');
  }
}

/** Hands a file to the browser's downloads, and says so, with a remark where there is one. */
export function saveAs(blob: Blob, name: string, remark = ''): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  tell(`Saved as ${name}${remark ? `. ${remark}` : ''}`);
  window.setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
