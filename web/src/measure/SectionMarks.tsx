/** Draws contour, diameters and measurements of a section over its picture. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { LineId, MeasuredSection, Pair, Plane, Vector } from '../core/messages';
import { pixelOn } from '../core/planes';
import { pulledContour } from '../state/contour';
import { pickedPlace } from '../state/store';
import { engine } from '../worker/engine';
import { ContourGrips } from './ContourGrips';
import { currentProfile, currentVessel } from './current';
import { nearestSection, sectionNumbers } from './sections';
import { area, doubtWords, meanings, mm, spread, withKnownUnits } from './words';

/** Contour colours, as in the pictures of `lumencut measure`. */
export const CONTOUR = {
  counts: '#00e5ff',
  leftOut: '#ff9f1a',
  outer: '#ff5ad0',
  own: '#5ae678',
  other: '#b28cff',
} as const;
/** The flag of contours drawn by hand. */
const BY_HAND = 'by hand';
const AXES = { shortest: '#ffdc00', longest: '#ffffff' } as const;

interface Found {
  readonly line: LineId;
  readonly section: MeasuredSection;
}

interface Contour {
  readonly points: readonly Vector[];
  readonly color: string;
  readonly isDashed: boolean;
}

/** The contours of a section: its lumen, the outer wall, and both lumens at a flap. */
export function contours(section: MeasuredSection, counts: boolean): readonly Contour[] {
  const all = [
    { points: section.contour, color: counts ? CONTOUR.counts : CONTOUR.leftOut, isDashed: false },
    { points: section.outer_contour, color: CONTOUR.outer, isDashed: true },
    { points: section.own_lumen, color: CONTOUR.own, isDashed: false },
    { points: section.other_lumen, color: CONTOUR.other, isDashed: false },
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
  const isShown = found?.line === vessel?.line && found?.section.number === nearestSection(profile, at);
  const [outer, lumens] = [profile.outer, profile.lumens].map((words) => words[nearestSection(profile, at)]);
  const section = isShown ? found?.section : null;
  const pulled = pulledContour.value;
  const shown = section
    ? contours({ ...section, contour: pulled?.points ?? section.contour }, numbers.counts)
    : [];
  const pixels = (points: readonly Vector[]): Pair[] => points.map((point) => pixelOn(plane, point));
  return (
    <>
      {section && shown.length > 0 && (
        <svg class="section-marks" width={plane.size[0]} height={plane.size[1]} aria-hidden="true">
          {shown.map(({ points, color, isDashed }) => (
            <path
              key={color}
              d={`M${pixels(points).join('L')}Z`}
              stroke={color}
              stroke-dasharray={isDashed ? '4 3' : undefined}
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
        {lumens && <div style={{ color: CONTOUR.own }}>{withKnownUnits(lumens)}</div>}
        {!numbers.counts && <div style={{ color: CONTOUR.leftOut }}>left out</div>}
        {numbers.flags.length > 0 && (
          <div title={meanings(profile, numbers.flags)}>{doubtWords(numbers).join(', ')}</div>
        )}
      </div>
      <ContourGrips plane={plane} at={numbers.at} isByHand={numbers.flags.includes(BY_HAND)} />
    </>
  );
}
