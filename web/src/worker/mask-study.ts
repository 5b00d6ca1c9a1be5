/** The engine as readers of files have it while they read a mask beside the scan that is open. */
import { Failure } from '../core/failure';
import type { Engine } from '../core/module';
import type { Study } from '../io/study';

export class MaskStudy implements Study {
  constructor(private readonly engine: Engine) {}

  begin_volume(header: string): void {
    this.engine.begin_mask(header);
  }

  take_voxels(offset: number, bytes: Uint8Array): void {
    this.engine.take_mask_voxels(offset, bytes);
  }

  open_centerlines(_bytes: Uint8Array, name: string): string {
    throw new Failure('format', name, 'centerlines', 'a mask of vessels', 'open centerlines as such');
  }
}
