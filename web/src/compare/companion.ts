/** The page with the other scan, in a frame of the main page: what it offers to that page. */
import { effect } from '@preact/signals';
import { expose, windowEndpoint } from 'comlink';
import { Failure } from '../core/failure';
import type { LinkedPlace, MeasuredScan, OtherScan, Seen } from '../core/linked';
import type { Vector } from '../core/messages';
import { composed } from '../output/pictures';
import { pngOf } from '../output/report-pictures';
import { showOneIfNarrow } from '../state/actions';
import { followSeen, scanNow, takeSeen } from '../state/linked-view';
import { crossHair } from '../state/store';
import { beCompanion } from '../state/two-scans';
import { leave } from '../study/unsaved';
import { measuredHere, placeAt } from './measured';
import { followOperation } from './operation';

/** What the companion sends to the main page. `turn` is the number of the last view that it took. */
export interface Listener {
  seen(seen: Seen, turn: number): void;
  scan(scan: OtherScan | null): void;
  left(): void;
}

export class Companion {
  private turn = 0;
  private listener: Listener | null = null;

  follow(listener: Listener): void {
    this.listener = listener;
    followSeen((seen) => listener.seen(seen, this.turn));
    effect(() => listener.scan(scanNow()));
  }

  show(seen: Seen, turn: number): void {
    this.turn = turn;
    takeSeen(seen);
  }

  crossHair(): Vector | null {
    return crossHair.value?.point ?? null;
  }

  placeAt(point: Vector): Promise<LinkedPlace> {
    return placeAt(point);
  }

  async measured(): Promise<MeasuredScan> {
    try {
      return await measuredHere();
    } catch (error) {
      throw new Error(Failure.of(error).text);
    }
  }

  /** The turning view with its labels (PNG in base64). */
  async picture(): Promise<string> {
    return pngOf(await composed('labels'));
  }

  /** Calls `left` after the user has agreed to lose unsaved work. */
  leave(): Promise<void> {
    return leave(async () => this.listener?.left());
  }
}

/** Makes this page the companion of the page around it. */
export function offerToMainPage(): void {
  beCompanion();
  showOneIfNarrow(window.innerWidth);
  followOperation();
  expose(new Companion(), windowEndpoint(window.parent), [window.location.origin]);
}
