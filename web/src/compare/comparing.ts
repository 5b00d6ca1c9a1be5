/** Compares the picked vessels of both scans, pairs places, and saves the comparison. */
import { Failure } from '../core/failure';
import type { Pair, ScansToCompare } from '../core/messages';
import { fileName } from '../output/file-names';
import { composed, saveAs } from '../output/pictures';
import { pngOf } from '../output/report-pictures';
import { isScanNamed } from '../state/questions';
import * as store from '../state/store';
import {
  addPair,
  beginComparison,
  comparison,
  endComparison,
  isOtherEarlier,
  pairs,
  type VesselComparison,
} from '../state/two-scans';
import { engine } from '../worker/engine';
import { measuredHere, placeAt } from './measured';
import { otherPage } from './other-page';

const FIRST_SIZE: Pair = [1000, 260];

/** Measures the picked vessels of both scans, and compares them. `isAnyPatient` accepts scans of two patients. */
export async function compareVessels(isAnyPatient = false): Promise<void> {
  beginComparison();
  try {
    const [here, there] = await Promise.all([measuredHere(), otherPage().measured()]);
    const isEarlier = isOtherEarlier.value;
    const inOrder = <T>(own: T, other: T): [T, T] => ordered(isEarlier, own, other);
    const places = await Promise.all(
      pairs.value.map((pair) => Promise.all([placeAt(pair[0]), otherPage().placeAt(pair[1])])),
    );
    const asked: ScansToCompare = {
      records: inOrder(here.record, there.record),
      pairs: places.flatMap((pair) => {
        const [a, b] = pair.map(({ at }) => at);
        const areOnVessels = pair[0].line === here.line && pair[1].line === there.line;
        return areOnVessels && a != null && b != null ? [inOrder(a, b)] : [];
      }),
      vessel: here.vessel,
      scans: inOrder(here.scan, there.scan),
      identities: inOrder(here.identity, there.identity),
      other_patient: isAnyPatient,
      is_named: true,
      pictures: [],
    };
    const answer = await engine.ask('compare_scans', { scans: asked, size: FIRST_SIZE });
    endComparison({ asked, answer, lines: [here.line, there.line], isOtherEarlier: isEarlier });
  } catch (error) {
    const failure = Failure.of(error);
    endComparison(failure.kind === 'interrupted' ? null : failure);
  }
}

/** What belongs to the earlier scan, then what belongs to the later one. */
const ordered = <T>(isEarlier: boolean, own: T, other: T): [T, T] =>
  isEarlier ? [other, own] : [own, other];

export async function drawComparison(found: VesselComparison, size: Pair): Promise<void> {
  const answer = await engine.ask('compare_scans', { scans: found.asked, size });
  if (comparison.value?.asked === found.asked) {
    endComparison({ ...found, answer });
  }
}

/** Records that the cross-hairs of both scans are at places that belong together. */
export async function pairPlaces(): Promise<void> {
  const [here, there] = [store.crossHair.value?.point, await otherPage().crossHair()];
  if (here && there) {
    addPair(here, there);
  }
}

/** Saves the comparison; a report shows the turning views of both scans. Only the reader's wish names the scans. */
export async function saveComparison(kind: 'html' | 'csv' | 'json'): Promise<void> {
  const found = comparison.value;
  if (!found) {
    throw new Failure('picture', 'comparison', 'none', 'a vessel compared in both scans');
  }
  const pictures = kind === 'html' ? await bothPictures(found.isOtherEarlier) : [];
  const scans = { ...found.asked, is_named: isScanNamed.value, pictures };
  const text = await engine.ask('comparison_file', { scans, kind });
  const scan = isScanNamed.value ? store.studyName.value : null;
  saveAs(new Blob([text], { type: TYPES[kind] }), fileName({ scan, content: 'comparison', ending: kind }));
}

async function bothPictures(isEarlier: boolean): Promise<readonly string[]> {
  const there = await otherPage().picture();
  return ordered(isEarlier, pngOf(await composed('labels')), there);
}

const TYPES = { html: 'text/html', csv: 'text/csv', json: 'application/json' } as const;
