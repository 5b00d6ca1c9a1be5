/** Outline and name of the picked vessel in the turning view. */
import type { LineContent } from '../core/messages';
import { nameOf } from '../state/changes';
import { contents } from '../state/lines';
import { placeTurn } from '../state/place-turn';
import { tree } from '../state/shown';
import { pickedVessel, report } from '../state/store';
import { isTracing } from '../state/tool';
import { around, type Disc, hullPath, thinned } from './hull';
import type { Projection } from './projection';

/** Distance of the outline from the vessel wall (CSS pixels). */
const GAP = 2;
const WIDTH = 2;
const DEFAULT_RADIUS_MM = 1;

export function PickedOutline({ projection }: { readonly projection: Projection }) {
  const vessel = tree.value[pickedVessel.value ?? -1];
  const line = vessel && contents.value.get(vessel.line);
  if (!line || tree.value.length < 2 || isTracing() || placeTurn.value) {
    return null;
  }
  const discs = thinned(discsOf(line, projection));
  const name = nameAt(discs, projection);
  const scan = around((report.value?.volume?.corners ?? []).map((corner) => projection.pixel(corner)));
  return (
    <svg class="picked-outline" aria-hidden="true">
      <clipPath id="in-the-scan">
        <polygon points={scan.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ')} />
      </clipPath>
      <mask id="outside-the-wall">
        <path d={hullPath(discs, GAP + WIDTH)} fill="#fff" />
        <path d={hullPath(discs, GAP)} fill="#000" />
      </mask>
      <rect
        width="100%"
        height="100%"
        fill={vessel.color}
        mask="url(#outside-the-wall)"
        clip-path="url(#in-the-scan)"
      />
      {name && (
        <text x={name.at[0] + name.radius + 8} y={name.at[1]}>
          {nameOf(vessel)}
        </text>
      )}
    </svg>
  );
}

function discsOf({ points, radius }: LineContent, projection: Projection): readonly Disc[] {
  return points.map((point, n) => ({
    at: projection.pixel(point),
    radius: (radius?.[n] ?? DEFAULT_RADIUS_MM) / projection.spacing,
  }));
}

function nameAt(discs: readonly Disc[], { size }: Projection): Disc | undefined {
  const seen = discs.filter(({ at: [x, y] }) => x > 0 && y > 0 && x < size[0] && y < size[1]);
  return seen[Math.floor(seen.length / 2)];
}
