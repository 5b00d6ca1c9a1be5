/** The study of a series: the header of one of its images, and the UIDs of all its images. */
import type { ReadScan } from '../../core/scan-study';
import type { Bytes, Source } from '../source';
import { formatFailure } from '../words';
import { type ExaminedFile, pixelsOf } from './headers';
import type { Plan } from './judging';
import { isDicom } from './recognising';

/** The bytes before the pixel data; the whole file if it has no pixels or is deflated. */
export async function headOf(source: Source): Promise<Bytes> {
  if (!isDicom(await source.slice(0, Math.min(source.size, 256)))) {
    const advice = 'choose a file from the DICOM folder of the scan';
    throw formatFailure(source.path, 'no DICOM', 'a DICOM file of the study', advice);
  }
  const { pixels, isDeflated } = await pixelsOf(source);
  return source.slice(0, pixels && !isDeflated ? pixels.at : source.size);
}

export async function studyOf(plan: Plan, files: readonly ExaminedFile[]): Promise<ReadScan | null> {
  const images = [...new Set(plan.slices.map(({ file }) => files[file]?.image))].filter((one) => !!one);
  const [first] = images;
  if (!first) {
    return null;
  }
  const instances = images.map(({ header }) => header.attributes.SOPInstanceUID);
  return {
    isServed: false,
    hasStudy: true,
    header: await headOf(first.source),
    instances: [...new Set(instances.filter((uid) => typeof uid === 'string'))],
    studyCount: new Set(images.map(({ study }) => study)).size,
  };
}
