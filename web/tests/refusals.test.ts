/** Unreadable files are rejected immediately, with an explanation. */
import { randomBytes } from 'node:crypto';
import { describe, expect, test } from 'vitest';
import { archived, changed, file, gzipped, nifti, slice } from './made';
import { openSources } from './opened';

async function refusal(...sources: Parameters<typeof openSources>[0]): Promise<string> {
  const { failure } = await openSources(sources);
  expect(failure).not.toBeNull();
  expect(failure?.kind, failure?.message).not.toBe('unexpected');
  return failure?.message ?? '';
}

describe('volumes', { timeout: 60_000 }, () => {
  test('a complete file is read', async () => {
    const { memory, failure } = await openSources([file('v.nii.gz', gzipped(nifti()))]);
    expect(failure).toBeNull();
    expect(memory.header?.size).toEqual([7, 5, 3]);
    // The axes change from RAS to LPS; the shear stays the same.
    expect(memory.header?.world_from_index).toEqual([
      [-2, 0, 0, -5],
      [0, -3, -0.5, -6],
      [0, 0, 4, 7],
      [0, 0, 0, 1],
    ]);
    expect([...memory.values]).toEqual(Array.from({ length: 105 }, (_, i) => i));
  });

  test('the content of a file determines its format, not the name', async () => {
    const { memory } = await openSources([file('scan.dcm', nifti())]);
    expect(memory.header?.size).toEqual([7, 5, 3]);
  });

  test('a file with a wrong checksum is damaged', async () => {
    const packed = gzipped(nifti([40, 40, 40]));
    expect(await refusal(file('v.nii.gz', changed(packed, packed.length - 6)))).toContain('damaged');
  });

  test('a truncated stream is rejected', async () => {
    const packed = gzipped(nifti([40, 40, 40]));
    expect(await refusal(file('v.nii.gz', packed.subarray(0, packed.length - 3000)))).toContain(
      'bytes of voxels',
    );
    expect(await refusal(file('v.nii.gz', packed.subarray(0, packed.length - 5)))).toContain('breaks off');
  });

  test('no memory is allocated for a stated size that the file does not contain', async () => {
    const huge = nifti([7, 5, 3], [32000, 32000, 2]);
    for (const bytes of [huge, gzipped(huge)]) {
      const { memory, failure } = await openSources([file('v.nii', bytes)]);
      expect(failure?.message).toContain('bytes of voxels');
      expect(memory.header).toBeNull();
    }
  });

  test('the unpacked size is checked before memory is allocated', async () => {
    const head = nifti([7, 5, 3], [400, 400, 400]).subarray(0, 352);
    const zeros = Buffer.concat([head, randomBytes(200_000), Buffer.alloc(99_800_000)]);
    const { memory, failure } = await openSources([file('v.nii', gzipped(zeros))]);
    expect(failure?.found).toBe('100000000 bytes of voxels');
    expect(memory.header).toBeNull();
  });

  test('every truncated file is rejected', async () => {
    const whole = nifti();
    for (let length = 0; length < whole.length; length += 7) {
      await refusal(file('v.nii', whole.subarray(0, length)));
    }
  });
});

describe('DICOM', { timeout: 60_000 }, () => {
  const series = [0, 1, 2].map((z) => file(`scan/IM${z}`, slice({}, z)));

  test('a plain series is read', async () => {
    const { memory, failure } = await openSources([...series].reverse());
    expect(failure?.message).toBeUndefined();
    expect(memory.header?.world_from_index).toEqual([
      [0.75, 0, 0, 0],
      [0, 0.5, 0, 0],
      [0, 0, 2, 0],
      [0, 0, 0, 1],
    ]);
    expect([...memory.values].slice(10, 14)).toEqual([10, 11, 100, 101]);
  });

  test('every truncated slice is rejected, or the other slices are read', async () => {
    const whole = slice({}, 2);
    for (let length = 0; length < whole.length; length += 5) {
      const { failure } = await openSources([
        ...series.slice(0, 2),
        file('scan/IM2', whole.subarray(0, length)),
      ]);
      expect(failure?.kind).not.toBe('unexpected');
    }
  });

  test('a file with any changed byte is read or rejected', async () => {
    const whole = slice({}, 2);
    for (let at = 0; at < whole.length; at += 1) {
      const { failure } = await openSources([...series.slice(0, 2), file('scan/IM2', changed(whole, at))]);
      expect(failure?.kind, `byte ${at}: ${failure?.message}`).not.toBe('unexpected');
    }
  });

  test('fractional slopes give floats, integer slopes the integer type that holds the values', async () => {
    const scaled = (slope: string) =>
      [0, 1, 2].map((z) => file(`s/${z}`, slice({ '00281053': slope, '00281052': '-1024' }, z)));
    expect((await openSources(scaled('1'))).memory.header?.dtype).toBe('int16');
    expect((await openSources(scaled('0.5'))).memory.header?.dtype).toBe('float32');
    const wide = await openSources(scaled('300'));
    expect(wide.memory.header?.dtype).toBe('float32');
    expect(wide.memory.values[35]).toBe(300 * 211 - 1024);
  });

  test('an archive is read; one with wrong or too large stated sizes is rejected', async () => {
    const inside = slice({}, 0);
    const { memory } = await openSources([file('a.zip', archived('IM0', inside))]);
    expect(memory.header?.size).toEqual([4, 3, 1]);
    expect(await refusal(file('a.zip', archived('IM0', inside, 3_000_000_000)))).toContain(
      'claims to unpack',
    );
    expect(await refusal(file('a.zip', archived('IM0', inside, inside.length - 20)))).toContain('damaged');
    expect(await refusal(file('a.zip', changed(archived('IM0', inside), 60)))).toContain('damaged');
    expect(await refusal(file('a.zip', archived('IM0', inside).subarray(0, 200)))).toContain('damaged');
  });
});

describe('opening files', { timeout: 60_000 }, () => {
  test('a mask together with a scan is rejected with an explanation', async () => {
    const words = await refusal(file('ct.nii', nifti()), file('mask.nii', nifti()));
    expect(words).toContain('2 volumes, ct.nii and mask.nii');
    expect(words).toContain('lumencut trace');
  });

  test('centerlines are opened after their volume, or without one', async () => {
    const lines = file('lines.vtp', '<VTKFile type="PolyData">');
    const { memory } = await openSources([lines, file('ct.nii', nifti())]);
    expect(memory.lines).toBe('lines.vtp');
    const alone = await openSources([lines]);
    expect(alone.memory).toMatchObject({ lines: 'lines.vtp', header: null });
  });

  test('files of unknown formats are named', async () => {
    expect(await refusal(file('a.pdf', '%PDF-1.7 ...'))).toContain('a.pdf: found a file of unknown format');
    expect(await refusal(file('empty', ''))).toContain('an empty file');
    expect(await refusal(file('v.vti', '<VTKFile type="ImageData">'))).toContain(
      'a VTK image, which is not read',
    );
    expect(
      await refusal(
        file(
          'v.mhd',
          'ObjectType = Image\nNDims = 3\nDimSize = 1 1 1\nElementType = MET_UCHAR\nElementDataFile = v.raw\n',
        ),
      ),
    ).toContain('bring both files together');
  });

  test('loading can be stopped between two pieces', async () => {
    const stop = new AbortController();
    const begun = openSources([file('v.nii', nifti([400, 400, 100]))], { signal: stop.signal });
    stop.abort();
    expect((await begun).failure?.kind).toBe('interrupted');
  });
});
