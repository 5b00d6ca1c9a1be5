/** Opens a DICOM segmentation (SEG) as a vessel mask. The server resamples it to the grid of the scan. */
import type { DocumentVessel, GivenFile } from '../core/messages';
import { inBase64, made } from '../core/server';
import { report, scanStudy } from '../state/store';

/** Finds the SOP class of a segmentation or RT Structure Set in the first bytes of a file. */
const CLASSES = /1\.2\.840\.10008\.5\.1\.4\.1\.1\.(66\.[47]|481\.3)[^.\d]/;
const HEAD = 1024;

export interface NamedMask {
  readonly mask: readonly GivenFile[];
  readonly names: Readonly<Record<string, string>>;
  readonly notes: readonly string[];
}

export async function isSegmentation(files: readonly GivenFile[]): Promise<boolean> {
  const [only] = files;
  return files.length === 1 && only !== undefined && CLASSES.test(await only.file.slice(0, HEAD).text());
}

export async function maskOf({ file }: GivenFile): Promise<NamedMask> {
  const volume = report.value?.volume;
  const known = scanStudy.value;
  const header = known?.isServed === false ? await inBase64(new Blob([known.header])) : null;
  const answer = await made('mask', file.name, {
    name: file.name,
    file: await inBase64(file),
    size: volume?.size,
    world_from_index: volume?.world_from_index,
    is_served: known?.isServed ?? false,
    header,
  });
  const { mask, names, notes } = await answer.json();
  const bytes = Uint8Array.from(atob(mask), (letter) => letter.charCodeAt(0));
  const path = `${file.name}.nrrd`;
  return { mask: [{ path, file: new File([bytes], path) }], names, notes };
}

/** Replaces the label number in a vessel name, which the engine writes for several labels, by the segment name. */
export function namedBySegment(vessel: DocumentVessel, names: NamedMask['names']): DocumentVessel {
  const [only, ...others] = Object.values(names);
  const byLabel = () => vessel.name.replace(/^label (\d+)/, (words, label: string) => names[label] ?? words);
  return { ...vessel, name: only !== undefined && others.length === 0 ? only : byLabel() };
}
