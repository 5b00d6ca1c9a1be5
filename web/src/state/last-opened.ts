/** Opens rejected files again, with a choice that the user made. */
import type { SeriesWish } from '../core/messages';

type Open = (wish: SeriesWish) => Promise<void>;

let last: { readonly open: Open; readonly wish: SeriesWish } = { open: async () => {}, wish: {} };

export function openWith(wish: SeriesWish, open: Open): Promise<void> {
  last = { open, wish };
  return open(wish);
}

export function openAgain(wish: SeriesWish): Promise<void> {
  return openWith({ ...last.wish, ...wish }, last.open);
}
