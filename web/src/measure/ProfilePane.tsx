/** The picked vessel, shown horizontally above its diameter chart; both have the same axis and marked places. */
import { useMemo, useRef, useState } from 'preact/hooks';
import type { Axis, ChartLayout, MeasureLayout, Pair, Profile } from '../core/messages';
import { usePaneSize } from '../pane/pane-size';
import { hasMillimetres } from '../state/millimetres';
import * as store from '../state/store';
import { currentPlaces, currentProfile, currentVessel } from './current';
import { LyingCpr } from './LyingCpr';
import { pixelAt, useMeasureLayout, valueAt } from './layout';
import { useLineGrips } from './line-grips';
import { NoProfile } from './NoProfile';
import { COLORS, PlaceHandles } from './PlaceHandles';
import { ProfileChart } from './ProfileChart';
import { ProfileReading } from './ProfileReading';
import { SectionTools, TOOLS } from './SectionTools';
import { sectionNumbers } from './sections';

/** Distance of the handles from the edge, clear of the lumen. */
const HANDLE_INSET_PX = 9;

export function ProfilePane() {
  const pane = useRef<HTMLDivElement>(null);
  const size = usePaneSize(pane);
  const layout = useMeasureLayout(size);
  const grips = useLineGrips(currentProfile.value && (layout?.x ?? null));
  return (
    <div class="profile-pane" ref={pane} {...grips}>
      {size && <ProfileContent size={size} layout={layout} />}
    </div>
  );
}

interface ContentProps {
  readonly size: Pair;
  readonly layout: MeasureLayout | null;
}

function ProfileContent({ size, layout }: ContentProps) {
  const profile = currentProfile.value;
  if (!currentVessel.value) {
    const hint = store.hasTree.value
      ? 'Pick a vessel: click on it in the view above.'
      : 'No vessel yet: trace one, or open centerlines.';
    return <p class="no-profile">{hint}</p>;
  }
  if (!layout) {
    return <NoProfile height={size[1]} />;
  }
  const { x, strip, chart } = layout;
  const height = Math.round(strip.height);
  return (
    <>
      <LyingCpr x={x} lying={strip} height={height} />
      {profile && chart ? (
        <Chart profile={profile} x={x} layout={chart} height={height} />
      ) : (
        <NoProfile height={size[1] - height - TOOLS} />
      )}
    </>
  );
}

interface ChartProps {
  readonly profile: Profile;
  readonly x: Axis;
  readonly layout: ChartLayout;
  /** Height of the vessel above the chart. */
  readonly height: number;
}

function Chart({ profile, x, layout, height }: ChartProps) {
  const hasUnits = hasMillimetres.value;
  const [hovered, setHovered] = useState<number | null>(null);
  const drawn = useMemo(
    () => <ProfileChart x={x} layout={layout} hasUnits={hasUnits} />,
    [x, layout, hasUnits],
  );
  const top = height + TOOLS;
  const heightAt = (at: number): number => {
    const { diameter } = sectionNumbers(profile, at);
    return top + pixelAt(layout.y, Math.min(diameter ?? 0, layout.y.high));
  };
  const atOf = ([column]: Pair) => valueAt(x, column);
  return (
    <>
      <ProfileReading profile={profile} x={x} top={top} hovered={hovered} onHover={setHovered}>
        {drawn}
      </ProfileReading>
      <SectionTools column={pixelAt(x, store.pickedPlace.value)} width={layout.size[0]} top={height} />
      <div class="overlay places">
        <PlaceLines x={x} top={top} bottom={top + layout.bottom} />
        <PlaceHandles
          view="in the CPR"
          pixelAt={(at, { kind }) => [pixelAt(x, at), gripOf(kind, height)]}
          atOf={atOf}
        />
        <PlaceHandles
          view="in the profile"
          pixelAt={(at, { kind }) => [
            pixelAt(x, at),
            isStretch(kind) ? top + layout.y.end + 6 : heightAt(at),
          ]}
          atOf={atOf}
        />
      </div>
    </>
  );
}

const isStretch = (kind: string): boolean => kind === 'stretch' || kind === 'secondStretch';

/** Row of a handle (pixels): stretches have handles at the lower edge, other places at the upper edge. */
const gripOf = (kind: string, height: number): number =>
  isStretch(kind) ? height - HANDLE_INSET_PX : HANDLE_INSET_PX;

interface PlaceLinesProps {
  readonly x: Axis;
  readonly top: number;
  readonly bottom: number;
}

function PlaceLines({ x, top, bottom }: PlaceLinesProps) {
  const section = pixelAt(x, store.pickedPlace.value);
  const places = currentPlaces.value;
  const ends = (kind: string) =>
    places.filter((place) => place.kind === kind).map(({ at }) => pixelAt(x, at));
  return (
    <svg class="place-lines" width="100%" height={bottom} aria-hidden="true">
      {(['stretch', 'secondStretch'] as const).map((kind) => {
        const [from, to] = ends(kind);
        return from === undefined || to === undefined ? null : (
          <rect
            key={kind}
            x={from}
            width={to - from}
            y={top}
            height={bottom - top}
            fill={COLORS[kind]}
            opacity="0.13"
          />
        );
      })}
      {places.map((place) => (
        <path
          key={`${place.kind} ${place.slot}`}
          d={`M${pixelAt(x, place.at)} 0V${bottom}`}
          stroke={COLORS[place.kind]}
          stroke-dasharray={place.isSuggestion ? '4 4' : undefined}
        />
      ))}
      <path class="section-line" d={`M${section} 0V${bottom}`} />
    </svg>
  );
}
