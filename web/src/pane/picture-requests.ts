/** Asks for the pictures of a pane, one at a time; of the wishes that arrive meanwhile, only the last is asked for. */
import { Failure } from '../core/failure';
import { Latest } from '../core/latest';
import type { Pair, Picture } from '../core/messages';

export interface Wish {
  readonly ask: (size: Pair) => Promise<Picture>;
  readonly size: Pair;
  readonly label: string;
}

interface Pane {
  show(picture: Picture, label: string): void;
  /** Called once the pane shows the last wish, or nothing more is wished. */
  rest(): void;
  fail(error: unknown): void;
}

export class PictureRequests {
  private readonly latest = new Latest();
  private wish: Wish | null = null;

  constructor(private readonly pane: Pane) {}

  want(wish: Wish | null): void {
    this.wish = wish;
    if (wish) {
      this.latest.run(() => this.answer(wish));
    } else {
      this.pane.rest();
    }
  }

  private async answer(wish: Wish): Promise<void> {
    try {
      const picture = await wish.ask(wish.size);
      if (this.wish) {
        this.pane.show(picture, wish.label);
      }
    } catch (error) {
      if (this.wish !== wish) {
        return;
      }
      // The user stopped other work, not this picture: without it, the old one would stay under the new label.
      if (Failure.of(error).kind === 'interrupted') {
        this.want(wish);
        return;
      }
      this.pane.fail(error);
    }
    if (this.wish === wish) {
      this.pane.rest();
    }
  }
}
