/** Draws contour, diameters and measurements of a section over its picture. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { LineId, MeasuredSection, Pair, Plane, Profile, Vector } from '../core/messages';
import { pixelOn } from '../core/planes';
import { pulledContour } from '../state/contour';
import { pickedPlace } from '../state/store';
import { engine } from '../worker/engine';
import { ContourGrips } from './ContourGrips';
import { currentProfile, currentVessel } from './current';
import { nearestSection, sectionNumbers } from './sections';
import { area, doubtWords, meanings, mm, spread, withKnownUnits } from './words';

/** Contour colours, as in the pictures of `lumencut measure`; only the page shows contours by hand. */
export const CONTOUR = {
  counts: '#00e5ff',
  leftOut: '#ff9f1a',
  byHand: '#b4ff39',
  outer: '#ff5ad0',
  own: '#5ae678',
  other: '#b28cff',
} as const;
const DASHES = { none: [], byHand: [9, 4], outer: [5, 4] } as const;
/** The flag of contours drawn by hand. */
const BY_HAND = 'by hand';

export const isByHand = (profile: Profile, number: number): boolean =>
  profile.flags[number]?.includes(BY_HAND) ?? false;

export const contourColor = (profile: Profile, number: number): string => {
  const automatic = profile.counts[number] ? CONTOUR.counts : CONTOUR.leftOut;
  return isByHand(profile, number) ? CONTOUR.byHand : automatic;
};
const AXES = { shortest: '#ffdc00', longest: '#ffffff' } as const;

interface Found {
  readonly line: LineId;
  readonly section: MeasuredSection;
}

interface Contour {
  readonly points: readonly Vector[];
  readonly color: string;
  readonly dashes: readonly number[];
}

/** The contours of a section: its lumen, the outer wall, and both lumens at a flap. `pulled` replaces that of the lumen. */
export function contours(
  section: MeasuredSection,
  profile: Profile,
  pulled?: readonly Vector[],
): readonly Contour[] {
  const isDrawn = pulled !== undefined || isByHand(profile, section.number);
  const color = pulled ? CONTOUR.byHand : contourColor(profile, section.number);
  const all = [
    { points: pulled ?? section.contour, color, dashes: isDrawn ? DASHES.byHand : DASHES.none },
    { points: section.outer_contour, color: CONTOUR.outer, dashes: DASHES.outer },
    { points: section.own_lumen, color: CONTOUR.own, dashes: DASHES.none },
    { points: section.other_lumen, color: CONTOUR.other, dashes: DASHES.none },
  ];
  return all.filter(({ points }) => points.length > 0);
}

export function SectionMarks({ plane }: { readonly plane: Plane }) {
  const [vessel, profile] = [currentVessel.value, currentProfile.value];
  const at = pickedPlace.value;
  const [found, setFound] = useState<Found | null>(null);
  const latest = useRef(new Latest());
  useEffect(() => {
    if (!vessel || !profile) {
      setFound(null);
      return;
    }
    latest.current.run(async () => {
      const { line } = vessel;
      const section = await engine.ask('measured_section', { line, at }).catch(() => null);
      setFound(section && { line, section });
    });
  }, [vessel?.line, profile, at]);
  if (!profile) {
    return null;
  }
  const numbers = sectionNumbers(profile, at);
  // The section may have moved while its contour was requested.
  const number = nearestSection(profile, at);
  const isShown = found?.line === vessel?.line && found?.section.number === number;
  const [outer, lumens] = [profile.outer[number], profile.lumens[number]];
  const section = isShown ? found?.section : null;
  const pulled = pulledContour.value;
  const isDrawn = pulled !== null || isByHand(profile, number);
  const flags = numbers.flags.filter((flag) => flag !== BY_HAND);
  const shown = section ? contours(section, profile, pulled?.points) : [];
  const pixels = (points: readonly Vector[]): Pair[] => points.map((point) => pixelOn(plane, point));
  return (
    <>
      {section && shown.length > 0 && (
        <svg class="section-marks" width={plane.size[0]} height={plane.size[1]} aria-hidden="true">
          {shown.map(({ points, color, dashes }) => (
            <path
              key={color}
              d={`M${pixels(points).join('L')}Z`}
              stroke={color}
              stroke-dasharray={dashes.length > 0 ? dashes.join(' ') : undefined}
            />
          ))}
          {!pulled && section.longest && (
            <path d={`M${pixels(section.longest).join('L')}`} stroke={AXES.longest} />
          )}
          {!pulled && section.shortest && (
            <path d={`M${pixels(section.shortest).join('L')}`} stroke={AXES.shortest} />
          )}
        </svg>
      )}
      <div class="section-numbers" data-testid="section-numbers">
        <div>{mm(numbers.at, 1)}</div>
        <div>{`diameter ${pulled ? mm(pulled.diameter) : spread(numbers.diameter, numbers.uncertainty)}`}</div>
        <div style={{ color: AXES.shortest }}>{`shortest ${mm((pulled ?? numbers).shortest)}`}</div>
        <div style={{ color: AXES.longest }}>{`longest ${mm((pulled ?? numbers).longest)}`}</div>
        <div>{`area ${area((pulled ?? numbers).area)}`}</div>
        {outer && <div style={{ color: CONTOUR.outer }}>{withKnownUnits(outer)}</div>}
        {lumens?.map((words, n) => (
          <div key={words} style={{ color: [CONTOUR.own, CONTOUR.other][n] }}>
            {withKnownUnits(words)}
          </div>
        ))}
        {isDrawn && <div style={{ color: CONTOUR.byHand }}>contour by hand</div>}
        {!numbers.counts && <div style={{ color: CONTOUR.leftOut }}>left out</div>}
        {flags.length > 0 && (
          <div title={meanings(profile, flags)}>{doubtWords({ ...numbers, flags }).join(', ')}</div>
        )}
      </div>
      <ContourGrips plane={plane} at={numbers.at} isByHand={isByHand(profile, number)} />
    </>
  );
}
