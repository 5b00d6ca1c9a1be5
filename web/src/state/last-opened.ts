/** How what was opened last is opened again, after a refusal, with one more wish. */
import type { SeriesWish } from '../core/messages';

type Open = (wish: SeriesWish) => Promise<void>;

let last: { readonly open: Open; readonly wish: SeriesWish } = { open: async () => {}, wish: {} };

/** Opens with a wish, in a way that can be asked for again. */
export function openWith(wish: SeriesWish, open: Open): Promise<void> {
  last = { open, wish };
  return open(wish);
}

/** Opens the same again, with one more wish. */
export function openAgain(wish: SeriesWish): Promise<void> {
  return openWith({ ...last.wish, ...wish }, last.open);
}
