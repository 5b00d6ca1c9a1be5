/** Words in lines that are no wider than there is room. */

/** The lines of a text, broken between its words; a word that is too wide alone has a line of its own. */
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

/** The size of letters (pixels) with which a line of this width at the first size is no wider than it may be, but never unreadable. */
export const fittingSize = (size: number, wide: number, widest: number): number =>
  Math.max(Math.floor((size * widest) / wide), 11);
