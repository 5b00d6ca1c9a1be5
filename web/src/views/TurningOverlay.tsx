/** Overlay of the turning view: letters, scale bar, cross-hair and cube. */
import { pixelOf, rightOf } from '../core/camera';
import { negate } from '../core/vectors';
import { TurningMeasures } from '../measure/MeasureOverlay';
import { PlaceTurnBar } from '../measure/PlaceTurnBar';
import { RimLegend } from '../measure/RimLegend';
import { assumeOneMillimetre, hasMillimetres } from '../state/millimetres';
import { camera, crossHair, report, states } from '../state/store';
import { Cube } from './Cube';
import { EdgeLabels } from './EdgeLabels';
import { LumenInset } from './LumenInset';
import { PickedOutline } from './PickedOutline';
import { ofCamera } from './projection';
import { TracedOverlay } from './TracedOverlay';

export function TurningOverlay() {
  const seen = camera.value;
  const volume = report.value?.volume;
  if (!seen || !volume) {
    return null;
  }
  const hair = crossHair.value;
  const place = hair && pixelOf(seen, hair.point);
  return (
    <div class="overlay">
      <EdgeLabels
        right={rightOf(seen)}
        down={negate(seen.up)}
        size={seen.size}
        spacing={seen.pixel_spacing}
      />
      <TurningMeasures camera={seen} />
      <RimLegend />
      <PickedOutline projection={ofCamera(seen, volume)} />
      <TracedOverlay projection={ofCamera(seen, volume)} />
      {place && <HairLines at={place} />}
      {states.value.orientation && <Cube camera={seen} />}
      {!hasMillimetres.value && <NoMillimetres />}
      <PlaceTurnBar />
      <LumenInset view="turning" size={seen.size} />
    </div>
  );
}

/** Button shown in place of the scale bar if the voxel spacing is unknown. */
function NoMillimetres() {
  return (
    <button
      type="button"
      class="no-millimetres"
      title="This scan has no voxel spacing. This button assumes voxels of 1 mm; saved files then state the assumption. Undo reverts it."
      onClick={assumeOneMillimetre}
    >
      Assume 1 mm
    </button>
  );
}

/** The cross-hair: four short lines around a position, which stays visible itself. */
export function HairLines({ at }: { readonly at: readonly [number, number] }) {
  return (
    <svg
      class="hair"
      style={{ left: `${at[0]}px`, top: `${at[1]}px` }}
      width="41"
      height="41"
      aria-hidden="true"
    >
      <path d="M20.5 0v14M20.5 27v14M0 20.5h14M27 20.5h14" />
    </svg>
  );
}
