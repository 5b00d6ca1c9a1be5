/** Receives a study from the file readers; records whether they have begun to replace the open study. */
import type { PlaceDoubt } from '../core/generated/questions';
import type { SeriesWish } from '../core/messages';
import type { Engine } from '../core/module';
import type { Study, LoadContext as StudyMeans } from '../io/study';
import { ask, askAtOnce } from './answers';

export class Replacing implements Study {
  hasBegun = false;
  doubt: PlaceDoubt | null = null;

  constructor(
    private readonly engine: Engine,
    private readonly wish: SeriesWish,
  ) {}

  close(): void {
    this.hasBegun = true;
    ask(this.engine, 'close', null);
  }

  begin_volume(header: string): void {
    this.hasBegun = true;
    this.engine.begin_volume(header);
  }

  take_voxels(offset: number, bytes: Uint8Array): void {
    this.engine.take_voxels(offset, bytes);
  }

  openCenterlines(bytes: Uint8Array, name: string): readonly string[] {
    const { notes, doubt } = ask(this.engine, 'open_centerlines', { name, wish: this.wish }, { bytes });
    this.doubt = doubt;
    return notes;
  }

  sideNotes(text: string): readonly string[] {
    return askAtOnce('straightened_notes', { text });
  }
}

export interface LoadContext extends StudyMeans {
  readonly study: Study & { close(): void };
}
