/** Pictures as PNGs in a zip archive, numbered from 0. */
import { BlobReader, BlobWriter, configure, ZipWriter } from '@zip.js/zip.js/lib/zip-core-custom.js';

// Its workers would come from blobs, which the page does not allow.
configure({ useWebWorkers: false });

export class PictureArchive {
  // PNGs are packed already.
  private readonly zip = new ZipWriter(new BlobWriter('application/zip'), { level: 0 });
  private count = 0;

  async add(picture: HTMLCanvasElement): Promise<void> {
    const blob = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve, 'image/png'));
    if (blob) {
      await this.zip.add(`lumencut-${String(this.count).padStart(3, '0')}.png`, new BlobReader(blob));
      this.count += 1;
    }
  }

  finish(): Promise<Blob> {
    return this.zip.close();
  }
}
