/** The report of the picked vessel: gathers what was measured, its pictures and words. */
import { signal } from '@preact/signals';
import { version } from '../../package.json';
import { Failure } from '../core/failure';
import type { Profile } from '../core/measuring';
import { VIEW_METHODS } from '../core/method-names';
import { document_ } from '../edit/history';
import { asked } from '../measure/asking';
import { axisAlong } from '../measure/chart-layout';
import {
  type Answers,
  type CurrentVessel,
  currentMarks,
  currentProfile,
  currentVessel,
} from '../measure/current';
import { lyingIn } from '../measure/lying';
import { type Place, placesOf } from '../measure/marks';
import { COLORS } from '../measure/PlaceHandles';
import { givenFwhm } from '../measure/profiles';
import { rulerLength } from '../measure/rulers';
import { fittingSide, lengthOf, sectionNumbers } from '../measure/sections';
import {
  degrees,
  mm,
  NOTHING,
  notGradedWords,
  placeName,
  stenosisWords,
  told,
  unitless,
} from '../measure/words';
import * as store from '../state/store';
import { saveAs } from './pictures';
import { plotMarkup } from './ReportPlot';
import { type ReportContent, type ReportPicture, type ReportRow, reportPage } from './report-page';
import { lyingData, sectionPair, viewPicture } from './report-pictures';

/** The plot (pixels of its own), and the most that the lying vessel takes of it. */
const PLOT = { width: 1000, chart: 270, lying: 150, density: 1.6 } as const;

/** Whether reports name their scan. */
export const isScanNamed = signal(false);

/** Saves the report of the picked vessel. */
export async function saveReport(): Promise<void> {
  const content = await reportContent();
  const html = new Blob([reportPage(content)], { type: 'text/html' });
  saveAs(html, 'lumencut-report.html', content.ungraded ?? '');
}

async function reportContent(): Promise<ReportContent> {
  const [vessel, profile, marks] = [currentVessel.value, currentProfile.value, currentMarks.value];
  const number = store.pickedVessel.value;
  if (!vessel || !profile || !marks || number === null) {
    throw new Failure(
      'picture',
      'report',
      'no vessel that is measured',
      'one',
      'press m to measure the picked one',
    );
  }
  // Not what is shown at this moment: the answer to the last change may still be on its way.
  const answers = await asked(vessel.line, profile, marks);
  const places = placesOf(profile, marks, answers.suggested);
  const isSection = ({ kind }: Place) => kind === 'place' || kind === 'reference';
  const marked = places.filter((place) => isSection(place) && !place.isSuggestion);
  const suggested = places.filter((place) => isSection(place) && place.isSuggestion);
  const isNamed = isScanNamed.value && store.studyName.value !== '';
  const sectionsAt = async (those: readonly Place[]): Promise<ReportPicture[]> => {
    const sections = [];
    for (const place of those) {
      const data = await sectionPair({ vessel: number, line: vessel.line }, profile, place.at);
      sections.push({ data, words: `${placeName(place)} at ${mm(place.at, 1)}` });
    }
    return sections;
  };
  return {
    saved: new Date().toLocaleString('sv-SE', { dateStyle: 'short', timeStyle: 'short' }),
    vessel: vessel.name,
    length: mm(lengthOf(profile), 1),
    scan: isNamed ? store.studyName.value : null,
    ungraded: answers.notGraded === null ? null : notGradedWords(answers),
    ...findingsOf(answers),
    view: { data: await viewPicture(profile, places), words: viewWords() },
    plot: await plotOf(number, profile, places),
    rows: marked.map((place) => rowOf(profile, place)),
    sections: await sectionsAt(marked),
    suggestions: suggestionsOf(profile, suggested),
    suggestedSections: await sectionsAt(suggested),
    told: [settingsWords(vessel, profile), unitless()].join(' ').trim(),
    unit: store.states.value.spacing ? 'mm' : '',
  };
}

/** What was found, in words: never a percentage without its method, its references and mm. */
function findingsOf({ stenosis, stretch, secondStretch, angle }: Answers) {
  const findings = stenosis ? [stenosisWords(stenosis)] : [];
  const remarks = [
    ...(stenosis?.doubts ?? []),
    ...(stenosis?.group ? [`Group of the field: ${told(stenosis.group)}`] : []),
    ...[stretch, secondStretch].flatMap((one) =>
      one
        ? [
            `Stretch: length ${mm(one.length, 1)}, straight ${mm(one.straight, 1)}, tortuosity ${
              one.tortuosity?.toFixed(3) ?? NOTHING
            }${store.states.value.orientation ? `, C-arm ${one.c_arm}` : ''}`,
          ]
        : [],
    ),
    ...(angle === null ? [] : [`Angle between both stretches: ${degrees(angle)}`]),
    ...document_.value.rulers.map((ruler, n) => `Straight distance ${n + 1}: ${mm(rulerLength(ruler), 1)}`),
  ];
  return { findings, remarks };
}

/** What Lumencut offers and no reader confirmed. */
function suggestionsOf(profile: Profile, suggested: readonly Place[]): ReportRow[] {
  const rows = suggested.map((place) => rowOf(profile, place));
  const { widest } = profile;
  return widest
    ? [...rows, { ...numbersAt(profile, widest.at), place: 'longest diameter', color: null }]
    : rows;
}

const rowOf = (profile: Profile, place: Place): ReportRow => ({
  ...numbersAt(profile, place.at),
  place: placeName(place).replace(' (suggestion)', ''),
  color: COLORS[place.kind],
});

function numbersAt(profile: Profile, where: number): Omit<ReportRow, 'place' | 'color'> {
  const { at, diameter, uncertainty, shortest, longest, area, flags } = sectionNumbers(profile, where);
  const number = (value: number | null, digits = 2) => value?.toFixed(digits) ?? NOTHING;
  return {
    at: at.toFixed(1),
    diameter: `${number(diameter)} ± ${number(uncertainty)}`,
    shortest: number(shortest),
    longest: number(longest),
    area: number(area, 1),
    flags: flags.join(', ') || 'none',
  };
}

async function plotOf(vessel: number, profile: Profile, places: readonly Place[]): Promise<string> {
  const x = axisAlong(lengthOf(profile), PLOT.width);
  const fitting = fittingSide(profile);
  const lying = lyingIn(x, { height: PLOT.lying, density: PLOT.density, fitting });
  const { data, pixels } = await lyingData(vessel, lying);
  const size = [PLOT.width, PLOT.chart] as const;
  const hasUnits = store.states.value.spacing;
  return plotMarkup({ profile, places, lying, picture: data, pixels, size, hasUnits });
}

const METHODS = Object.fromEntries(VIEW_METHODS);

const viewWords = (): string => `${METHODS[store.method.value]} of the vessels, as it was shown`;

/** How it was measured and shown. */
function settingsWords({ length }: CurrentVessel, profile: Profile): string {
  const [level, width] = store.window_.value;
  const chosen = Object.entries(store.settings.value).map(
    ([name, value]) =>
      `${name.replaceAll('_', ' ')} ${Array.isArray(value) ? value.join(' ') : (value ?? 'none')}`,
  );
  const settings = [
    `sections every ${mm((profile.arc_length[1] ?? length) - (profile.arc_length[0] ?? 0))}`,
    `FWHM ${givenFwhm.value === null ? 'as found' : mm(givenFwhm.value)}`,
    `view ${METHODS[store.method.value]}`,
    ...chosen,
    `window W ${width.toPrecision(4)} L ${level.toPrecision(4)}`,
  ];
  const counted = profile.counts.filter(Boolean).length;
  return (
    `Measured by Lumencut ${version}. Settings: ${settings.join('; ')}. ` +
    `FWHM of the point spread ${mm(profile.fwhm)}, ${profile.fwhm_source}. ` +
    `${profile.arc_length.length} sections, of which ${counted} count.`
  );
}
