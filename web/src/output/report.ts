/** Makes the report of the findings: the engine writes the text, the page adds the pictures. */
import { Failure } from '../core/failure';
import type { Profile, ReportVessel } from '../core/messages';
import { type Finding, findingOf, listedFindings, markedVessel, stated } from '../measure/findings';
import { notGradedWords } from '../measure/words';
import { document_ } from '../state/history';
import { leftOut } from '../state/measuring';
import { isMillimetreAssumed } from '../state/millimetres';
import { profileOfLine, profiles } from '../state/profiles';
import { isScanNamed } from '../state/questions';
import { rulerLength } from '../state/rulers';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { fileName } from './file-names';
import { saveAs } from './pictures';
import { pngOf, sectionPair, straightened, viewPicture } from './report-pictures';

export async function saveReport(): Promise<void> {
  const findings = reported();
  if (findings.length === 0) {
    const mend = 'press m to measure the picked vessel, or include a finding';
    throw new Failure('picture', 'report', 'no measured vessel', 'a measured vessel', mend);
  }
  const html = await reportOf(findings);
  const name = fileName({ scan: namedScan(), content: 'report', ending: 'html' });
  saveAs(new Blob([html], { type: 'text/html' }), name, await remarkOn(findings));
}

/** Vessels of the report: the included findings, and the picked vessel while measuring or if there are no findings. */
export function reported(): readonly Finding[] {
  const marked = listedFindings.value.filter(({ line }) => !leftOut.value.has(line));
  const picked = findingOf(store.pickedVessel.value ?? -1);
  const isListed = marked.some(({ line }) => line === picked?.line);
  const isShown = store.layout.value === 'measure' || listedFindings.value.length === 0;
  const isMeasured = picked && 'profile' in (profiles.value.get(picked.line) ?? {});
  return !picked || isListed || !isShown || !isMeasured
    ? marked
    : [...marked, picked].sort((a, b) => a.vessel - b.vessel);
}

async function remarkOn(findings: readonly Finding[]): Promise<string> {
  const grades = findings.map(({ line, marks }) => engine.ask('grade', { line, marks }));
  const missing = (await Promise.all(grades)).flatMap(({ not_graded: reason }) => (reason ? [reason] : []));
  const [first] = missing;
  if (first === undefined) {
    return '';
  }
  return findings.length === 1
    ? notGradedWords({ notGraded: first })
    : `${missing.length} of ${findings.length} vessels have no percentage; the report says why`;
}

/** The scan name if the user wants it in the report, otherwise null. */
const namedScan = (): string | null =>
  isScanNamed.value && store.studyName.value !== '' ? store.studyName.value : null;

/** The report as HTML; `scan` is the scan name in it, or null. */
export async function reportOf(findings: readonly Finding[], scan = namedScan()): Promise<string> {
  const vessels: ReportVessel[] = [];
  for (const finding of findings) {
    vessels.push(await pageOf(finding, await profileOfLine(finding.line)));
  }
  return engine.ask('measured_report', {
    vessels,
    scan,
    saved: new Date().toLocaleString('sv-SE', { dateStyle: 'short', timeStyle: 'short' }),
    stated: stated(),
    is_millimetre_assumed: isMillimetreAssumed.value,
    window: store.window_.value,
    settings: store.settings.value,
    distances: document_.value.rulers.map(rulerLength),
  });
}

async function pageOf(finding: Finding, profile: Profile): Promise<ReportVessel> {
  const vessel = markedVessel(finding);
  const plan = await engine.ask('report_plan', vessel);
  const sections: string[] = [];
  for (const { at } of plan.places) {
    sections.push(pngOf(await sectionPair({ ...finding, spacing: plan.section_spacing }, profile, at)));
  }
  return {
    vessel,
    view: { picture: await viewPicture(profile, plan.places), method: store.method.value },
    strip: await straightened(finding.vessel, plan),
    sections,
  };
}
