/** The page names files as the facade does. */
import { expect, test } from 'vitest';
import { FILES } from '../src/core/generated/tables';
import { known } from '../src/io/kinds';
import { BlobSource } from '../src/io/source';
import { kindOf } from '../src/worker/answers';
import { openSources } from './opened';

const file = (name: string, content: string) => new BlobSource(name, new Blob([content]));

test('every file that messages offer is named', async () => {
  const extensions = `${FILES.volumes} ${FILES.centerlines}`.match(/\.[a-z.]+/g) ?? [];
  expect(extensions.length).toBeGreaterThan(15);
  for (const extension of extensions.filter((one) => !['.img', '.nrrd', '.nhdr', '.vtk'].includes(one))) {
    const { role } = await known(file(`folder/a${extension}`, 'content that states nothing'), kindOf);
    expect([extension, role]).not.toEqual([extension, 'other']);
  }
});

test.each([
  ['a', '\x08\x00\x05\x00', 'dicom'],
  ['a.gz', '\x1f\x8bdamaged', 'unknown'],
  ['a.nii.gz', '\x1f\x8bdamaged', 'nifti'],
  ['a.vtp', '', 'empty'],
  ['a.vtp', '{"vtkClass": "vtkPolyData"}', 'vtk.js lines'],
])('%s with %j is %s', async (name, content, kind) => {
  const bytes = Uint8Array.from(content, (letter) => letter.charCodeAt(0));
  expect((await known(new BlobSource(name, new Blob([bytes])), kindOf)).kind).toBe(kind);
});

test('a file that is not read is refused with what mends it', async () => {
  const { failure } = await openSources([file('a.vtp', '{"vtkClass": "vtkPolyData"}')]);
  expect(failure?.message).toContain('PolyData in the JSON of vtk.js, which is not read');
  expect(failure?.message).toContain('write it as XML');
});
