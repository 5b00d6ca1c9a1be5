/** The engine as readers of files have it: it tells whether they began to replace what was open. */
import type { SeriesWish } from '../core/messages';
import type { Engine } from '../core/module';
import type { Study, Means as StudyMeans } from '../io/study';

export class Replacing implements Study {
  hasBegun = false;

  constructor(
    private readonly engine: Engine,
    private readonly wish: SeriesWish,
  ) {}

  close(): void {
    this.hasBegun = true;
    this.engine.close();
  }

  begin_volume(header: string): void {
    this.hasBegun = true;
    this.engine.begin_volume(header);
  }

  take_voxels(offset: number, bytes: Uint8Array): void {
    this.engine.take_voxels(offset, bytes);
  }

  open_centerlines(bytes: Uint8Array, name: string): string {
    return this.engine.open_centerlines(bytes, name, JSON.stringify(this.wish));
  }
}

/** What a study is loaded with. */
export interface Means extends StudyMeans {
  readonly study: Study & { close(): void };
}
