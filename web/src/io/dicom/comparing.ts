/** Compares the values of slices that have equal headers; `lumencut-dicom`, which makes the plan, sees only headers. */
import type { Numbers } from '../numbers';
import type { ExaminedFile, Image } from './headers';
import type { Compared, Plan, PlannedSlice } from './judging';
import { PixelReader } from './pixels';
import { inUnit } from './stack';

/** The pairs of slices with different values. Files with identical bytes are not decoded. */
export async function unlikePairs(plan: Plan, files: readonly ExaminedFile[]): Promise<Compared[]> {
  const [kept, others] = [new Values(files), new Values(files)];
  const equal = new Map<string, boolean>();
  const unlike: Compared[] = [];
  for (const pair of plan.compared) {
    const [one, other] = [kept.image(pair.kept), others.image(pair.other)];
    const key = `${pair.kept.file} ${pair.other.file}`;
    const isEqual = equal.get(key) ?? (areCopies(one, other) && (await haveSameBytes(one, other)));
    equal.set(key, isEqual);
    if (!isEqual && !areSame(await kept.read(pair.kept), await others.read(pair.other))) {
      unlike.push(pair);
    }
  }
  return unlike;
}

class Values {
  private readonly reader = new PixelReader();

  constructor(private readonly files: readonly ExaminedFile[]) {}

  image({ file }: PlannedSlice): Image {
    const image = this.files[file]?.image;
    if (!image) {
      throw new Error('the plan of the volume names a file without a header');
    }
    return image;
  }

  async read(slice: PlannedSlice): Promise<Numbers> {
    return inUnit(await this.reader.read(this.image(slice), slice.frame), slice);
  }
}

/** Whether two files have the same SOP instance UID. Frames of one file are never copies. */
function areCopies(one: Image, other: Image): boolean {
  const uid = one.header.attributes.SOPInstanceUID;
  return one !== other && Boolean(uid) && uid === other.header.attributes.SOPInstanceUID;
}

async function haveSameBytes({ source: one }: Image, { source: other }: Image): Promise<boolean> {
  return one.size === other.size && areSame(await one.slice(0, one.size), await other.slice(0, other.size));
}

function areSame(one: Numbers | Uint8Array, other: Numbers | Uint8Array): boolean {
  return one.length === other.length && (one as Uint8Array).every((value, n) => value === other[n]);
}
