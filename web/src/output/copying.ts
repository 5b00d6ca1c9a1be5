/** Copies sentences and pictures to the clipboard. */
import { Failure } from '../core/failure';
import { showMessage } from '../state/message';

export async function copyWords(words: string): Promise<void> {
  await copied(() => navigator.clipboard.writeText(words));
  showMessage('The sentence is copied');
}

/** Copies a picture. Browsers accept a promise of it, so it may still be being drawn. */
export async function copyPicture(picture: Promise<Blob>): Promise<void> {
  await copied(() => navigator.clipboard.write([new ClipboardItem({ 'image/png': picture })]));
  showMessage('The picture is copied');
}

async function copied(copy: () => Promise<void>): Promise<void> {
  try {
    await copy();
  } catch (error) {
    const mend = 'allow the page to use the clipboard, or save the report instead';
    throw new Failure('picture', 'clipboard', String(error), 'permission to copy', mend);
  }
}
