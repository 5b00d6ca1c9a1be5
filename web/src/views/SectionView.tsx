/** The section across the picked vessel. */
import { useEffect, useState } from 'preact/hooks';
import type { Pair, Plane } from '../core/messages';
import { engine } from '../core/shared';
import { placeCrossHair } from '../link/cross-hair';
import { dragWindow, windowBack } from '../state/actions';
import * as store from '../state/store';
import { useAsked } from './asked';
import { EdgeLabels } from './EdgeLabels';
import { FlatPicture } from './FlatPicture';
import { pixelOn, pointOn } from './planes';
import { HairLines } from './TurningOverlay';

/** The side of the section at first (mm). */
const FIRST_SIDE = 50;
/** The step of the wheel along the vessel (mm). */
const STEP = 0.5;

export function SectionView() {
  const vessel = store.pickedVessel.value;
  const at = store.pickedPlace.value;
  const window = store.window_.value;
  const [size, setSize] = useState<Pair | null>(null);
  const [side, setSide] = useState(FIRST_SIDE);
  const [frame, setFrame] = useState<Pick<Plane, 'center' | 'right' | 'down'> | null>(null);

  useEffect(() => {
    if (vessel === null) {
      setFrame(null);
    } else {
      void engine.across(vessel, at).then(([center, right, down]) => setFrame({ center, right, down }));
    }
  }, [vessel, at]);

  const plane = frame && size ? { ...frame, size, pixel_spacing: side / Math.min(...size) } : null;
  const ask = useAsked(plane, window);
  const point = (place: Pair) => {
    if (plane) {
      void engine.at(pointOn(plane, place)).then((pick) => placeCrossHair(pick, 'section'));
    }
  };
  const handlers = {
    drag: (action: string, by: Pair) => (action === 'window' ? dragWindow(by) : undefined),
    zoom: (factor: number) => setSide((before) => Math.min(Math.max(before / factor, 2), 500)),
    scroll: (steps: number) => moveAlong(steps * STEP),
    click: (action: string, place: Pair) => {
      if (action === 'maximise') {
        store.maximised.value = store.maximised.value === 'section' ? null : 'section';
      } else {
        point(place);
      }
    },
    hover: (place: Pair, shift: boolean) => (shift ? point(place) : undefined),
    ...windowBack(),
  };
  const hair = store.crossHair.value;
  return (
    <FlatPicture
      name="section"
      words="section across the picked vessel"
      ask={ask}
      handlers={handlers}
      onSize={setSize}
    >
      {plane && (
        <>
          <EdgeLabels right={plane.right} down={plane.down} size={plane.size} spacing={plane.pixel_spacing} />
          {hair && <HairLines at={pixelOn(plane, hair.point)} />}
        </>
      )}
    </FlatPicture>
  );
}

/** Moves along the picked vessel (mm). */
export function moveAlong(by: number): void {
  const vessel = store.pickedVessel.value;
  const length = vessel === null ? 0 : (store.report.value?.vessels?.[vessel]?.length ?? 0);
  const at = Math.min(Math.max(store.pickedPlace.value + by, 0), length);
  store.pickedPlace.value = at;
  if (vessel !== null) {
    void engine
      .across(vessel, at)
      .then(([center]) => engine.at(center))
      .then((pick) => placeCrossHair({ ...pick, vessel, arc_length: at }, 'section'));
  }
}
