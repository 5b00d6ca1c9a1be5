/** Fits text into a width, for drawing on a canvas. */

/** Lines of text, broken between words; a word that is too wide gets its own line. */
export function wrapped(text: string, room: number, width: (text: string) => number): string[] {
  const lines: string[] = [];
  for (const word of text.split(' ').filter((part) => part !== '')) {
    const last = lines.at(-1);
    if (last !== undefined && width(`${last} ${word}`) <= room) {
      lines[lines.length - 1] = `${last} ${word}`;
    } else {
      lines.push(word);
    }
  }
  return lines;
}

/** Font size (pixels) at which a text fits a width, but not below a readable minimum. */
export const fittingSize = (size: number, wide: number, widest: number): number =>
  Math.max(Math.floor((size * widest) / wide), 11);
