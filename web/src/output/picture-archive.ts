/** Collects numbered PNG pictures in a zip archive. */
import { BlobReader, BlobWriter, configure, ZipWriter } from '@zip.js/zip.js/lib/zip-core-custom.js';

// The content security policy forbids the workers that zip.js would create from blobs.
configure({ useWebWorkers: false });

export class PictureArchive {
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
