/** What is copied to the clipboard: sentences and pictures. */
import { Failure } from '../core/failure';
import { tell } from '../state/telling';

/** Copies words, and says so. */
export async function copyWords(words: string): Promise<void> {
  await copied(() => navigator.clipboard.writeText(words));
  tell('The sentence is copied');
}

/** Copies a picture, which may still be drawn meanwhile, and says so. */
export async function copyPicture(picture: Promise<Blob>): Promise<void> {
  await copied(() => navigator.clipboard.write([new ClipboardItem({ 'image/png': picture })]));
  tell('The picture is copied');
}

/** Where a browser refuses its clipboard, what would mend it. */
async function copied(copy: () => Promise<void>): Promise<void> {
  try {
    await copy();
  } catch (error) {
    const mend = 'allow the page to use the clipboard, or save the report instead';
    throw new Failure('picture', 'clipboard', String(error), 'a browser that lets the page copy', mend);
  }
}
