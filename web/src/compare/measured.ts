/** The picked vessel of this page, measured for a comparison, and the place of its cross-hair. */
import { Failure } from '../core/failure';
import type { LinkedPlace, MeasuredScan } from '../core/linked';
import type { ScanIdentity, Vector } from '../core/messages';
import { currentVessel } from '../measure/current';
import { hasMillimetres } from '../state/millimetres';
import { profileOfLine } from '../state/profiles';
import { report, scanStudy, studyName } from '../state/store';
import { engine } from '../worker/engine';

const UNSTATED: ScanIdentity = { patient: '', issuer: '', modality: '' };

/** Measures the picked vessel. Throws `Failure` without one, or without lengths in mm. */
export async function measuredHere(): Promise<MeasuredScan> {
  const scan = studyName.value;
  const vessel = currentVessel.value;
  if (!vessel) {
    const advice = 'trace the vessel there, or pick it';
    throw new Failure(
      'measuring',
      'vessels to compare',
      `no vessel in ${scan}`,
      'the same vessel in both scans',
      advice,
    );
  }
  if (!hasMillimetres.value) {
    const advice = 'press "Assume 1 mm" if its voxels are 1 mm apart';
    throw new Failure(
      'measuring',
      'scans to compare',
      `no voxel spacing in ${scan}`,
      'lengths in mm',
      advice,
    );
  }
  await profileOfLine(vessel.line);
  return {
    line: vessel.line,
    vessel: vessel.name,
    record: await engine.ask('profile_record', { line: vessel.line }),
    scan,
    identity: scanStudy.value?.identity ?? UNSTATED,
  };
}

export async function placeAt(point: Vector): Promise<LinkedPlace> {
  const { vessel, arc_length: at } = await engine.ask('at', point);
  return { point, line: report.value?.vessels?.[vessel ?? -1]?.line ?? null, at };
}
