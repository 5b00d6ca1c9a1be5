/** Members of zip archives are inflated no further than needed. */
import { expect, test } from 'vitest';
import { membersOf } from '../src/io/dicom/archive';
import { archived, file } from './made';

test('reading part of a member of an archive takes memory only for that part', async () => {
  const content = Buffer.from(Uint8Array.from({ length: 3_000_000 }, (_, i) => (i * 7) % 251));
  const [member] = await membersOf(file('a.zip', archived('IM0', content)));
  const part = await member?.slice(1_500_000, 1_500_010);
  expect(part?.buffer.byteLength).toBe(10);
  expect([...(part ?? [])]).toEqual([...content.subarray(1_500_000, 1_500_010)]);
  expect((await member?.slice(2_999_990, 4_000_000))?.length).toBe(10);
  expect((await member?.slice(4_000_000, 5_000_000))?.length).toBe(0);
});
