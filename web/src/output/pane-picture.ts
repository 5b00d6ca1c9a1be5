/** Saves the picture of a section or reformation with a caption. */
import { Failure } from '../core/failure';
import { isInverted, type ViewName } from '../state/store';
import { studyFileName } from './file-names';
import { saveAs } from './pictures';
import { canvasOf } from './report-pictures';
import { wrapped } from './wrapping';

const FONT = '13px system-ui, sans-serif';
const [LINE, MARGIN] = [17, 8];
const LEAST_WIDTH = 320;

export async function savePane(name: ViewName, content: string, words: string): Promise<void> {
  const shown = document.querySelector<HTMLCanvasElement>(`[data-testid=${name}] canvas.flat`);
  if (!shown || shown.width < 2) {
    throw new Failure('picture', 'picture', 'no picture', 'a view with a picture');
  }
  const canvas = drawnPane(shown, words);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (blob) {
    saveAs(blob, studyFileName({ content, ending: 'png' }));
  }
}

export function drawnPane(shown: HTMLCanvasElement, words: string): HTMLCanvasElement {
  const [canvas, context] = canvasOf(Math.max(shown.width, LEAST_WIDTH), shown.height);
  context.font = FONT;
  const lines = wrapped(words, canvas.width - 2 * MARGIN, (text) => context.measureText(text).width);
  canvas.height = shown.height + lines.length * LINE + 2 * MARGIN;
  context.fillStyle = '#000';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.filter = isInverted.value ? 'invert(1)' : 'none';
  context.drawImage(shown, Math.floor((canvas.width - shown.width) / 2), 0);
  context.filter = 'none';
  context.font = FONT;
  context.fillStyle = '#fff';
  context.textBaseline = 'top';
  lines.forEach((line, n) => {
    context.fillText(line, MARGIN, shown.height + MARGIN + n * LINE);
  });
  return canvas;
}
