/** The report of the picked vessel: the engine writes it, the page gives its pictures. */
import { signal } from '@preact/signals';
import { engine } from '../client/shared';
import { Failure } from '../core/failure';
import type { MeasuredVessel, Profile } from '../core/messages';
import { currentMarks, currentProfile, currentVessel } from '../measure/current';
import { notGradedWords } from '../measure/words';
import { document_ } from '../state/history';
import { hasMillimetres, isMillimetreAssumed } from '../state/millimetres';
import { rulerLength } from '../state/rulers';
import * as store from '../state/store';
import { fileName } from './file-names';
import { saveAs } from './pictures';
import { sectionPair, straightened, viewPicture } from './report-pictures';

/** Whether reports name their scan. */
export const isScanNamed = signal(false);

/** Saves the report of the picked vessel. */
export async function saveReport(): Promise<void> {
  const [vessel, profile] = measuredVessel();
  const html = await reportOf(vessel, profile);
  const { not_graded: notGraded } = await engine.ask('grade', { line: vessel.line, marks: vessel.marks });
  const name = fileName({ scan: namedScan(), content: 'report', ending: 'html' });
  const words = notGraded === null ? '' : notGradedWords({ notGraded });
  saveAs(new Blob([html], { type: 'text/html' }), name, words);
}

/** The picked vessel by the id that it has in tables, which is its number, and its profile. */
function measuredVessel(): [MeasuredVessel, Profile] {
  const [vessel, profile, marks] = [currentVessel.value, currentProfile.value, currentMarks.value];
  const number = store.pickedVessel.value;
  if (!vessel || !profile || !marks || number === null) {
    const mend = 'press m to measure the picked one';
    throw new Failure('picture', 'report', 'no vessel that is measured', 'one', mend);
  }
  const name = store.report.value?.vessels?.[number]?.name ?? '';
  return [{ id: String(number), name, line: vessel.line, marks }, profile];
}

/** The scan by its name, where the reader wants the report to tell it. */
const namedScan = (): string | null =>
  isScanNamed.value && store.studyName.value !== '' ? store.studyName.value : null;

async function reportOf(vessel: MeasuredVessel, profile: Profile): Promise<string> {
  const number = Number(vessel.id);
  const plan = await engine.ask('report_plan', vessel);
  const sections: string[] = [];
  for (const { at } of plan.places) {
    sections.push(await sectionPair({ vessel: number, line: vessel.line, side: plan.side }, profile, at));
  }
  const { stretch, secondStretch } = currentMarks.value ?? {};
  return engine.ask('measured_report', {
    vessel,
    scan: namedScan(),
    saved: new Date().toLocaleString('sv-SE', { dateStyle: 'short', timeStyle: 'short' }),
    has_units: hasMillimetres.value,
    is_millimetre_assumed: isMillimetreAssumed.value,
    has_orientation: store.states.value.orientation,
    window: store.window_.value,
    settings: store.settings.value,
    view: { picture: await viewPicture(profile, plan.places), method: store.method.value },
    strip: await straightened(number, plan),
    sections,
    stretches: [stretch, secondStretch].flatMap((ends) => (ends ? [ends] : [])),
    distances: document_.value.rulers.map(rulerLength),
  });
}
