/** The picked vessel, shown horizontally above its diameter chart; both have the same axis and marked places. */
import { useMemo, useRef, useState } from 'preact/hooks';
import type { Pair, Profile } from '../core/messages';
import { usePaneSize } from '../pane/pane-size';
import { hasMillimetres } from '../state/millimetres';
import * as store from '../state/store';
import { axisAlong, chartLayout } from './chart-layout';
import { currentPlaces, currentProfile, currentVessel } from './current';
import { LyingCpr } from './LyingCpr';
import { useLineGrips } from './line-grips';
import { type Lying, lyingIn } from './lying';
import { NoProfile } from './NoProfile';
import { COLORS, PlaceHandles } from './PlaceHandles';
import { ProfileChart } from './ProfileChart';
import { ProfileReading } from './ProfileReading';
import { SectionTools, TOOLS } from './SectionTools';
import { type Axis, pixelAt, valueAt } from './scale';
import { fittingSide, sectionNumbers, UNKNOWN_SIDE } from './sections';

const VESSEL_HEIGHT_SHARE = 0.4;
/** Distance of the handles from the edge; there they do not cover the lumen. */
const HANDLE_INSET_PX = 9;

export function ProfilePane() {
  const pane = useRef<HTMLDivElement>(null);
  const size = usePaneSize(pane);
  const length = currentVessel.value?.length;
  const grips = useLineGrips(size && length && currentProfile.value ? axisAlong(length, size[0]) : null);
  return (
    <div class="profile-pane" ref={pane} {...grips}>
      {size && <ProfileContent size={size} />}
    </div>
  );
}

function ProfileContent({ size }: { readonly size: Pair }) {
  const vessel = currentVessel.value;
  const profile = currentProfile.value;
  if (!vessel) {
    const hint = store.hasTree.value
      ? 'Pick a vessel: click on it in the view above.'
      : 'No vessel yet: trace one, or open centerlines.';
    return <p class="no-profile">{hint}</p>;
  }
  const x = axisAlong(vessel.length, size[0]);
  const lying = lyingIn(x, {
    height: VESSEL_HEIGHT_SHARE * size[1],
    density: Math.min(window.devicePixelRatio || 1, 2),
    fitting: profile ? fittingSide(profile) : UNKNOWN_SIDE,
  });
  const vesselHeight = Math.round(lying.height);
  const below: Pair = [size[0], size[1] - vesselHeight - TOOLS];
  return (
    <>
      <LyingCpr x={x} lying={lying} height={vesselHeight} />
      {profile ? <Chart profile={profile} size={below} x={x} lying={lying} /> : <NoProfile size={below} />}
    </>
  );
}

interface ChartProps {
  readonly profile: Profile;
  readonly size: Pair;
  readonly x: Axis;
  readonly lying: Lying;
}

function Chart({ profile, size, x, lying }: ChartProps) {
  const hasUnits = hasMillimetres.value;
  const [hovered, setHovered] = useState<number | null>(null);
  const layout = useMemo(() => chartLayout(profile, size), [profile, size[0], size[1]]);
  const drawn = useMemo(
    () => <ProfileChart profile={profile} layout={layout} hasUnits={hasUnits} />,
    [profile, layout, hasUnits],
  );
  const top = Math.round(lying.height) + TOOLS;
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
      <SectionTools column={pixelAt(x, store.pickedPlace.value)} width={size[0]} top={top - TOOLS} />
      <div class="overlay places">
        <PlaceLines x={x} top={top} bottom={top + layout.bottom} />
        <PlaceHandles
          view="in the CPR"
          pixelAt={(at, { kind }) => [pixelAt(x, at), gripOf(kind, lying.height)]}
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
