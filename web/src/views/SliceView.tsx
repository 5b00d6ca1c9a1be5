/** An axial, coronal or sagittal slice through the cross-hair. */
import { useEffect, useRef, useState } from 'preact/hooks';
import type { Pair, Plane } from '../core/messages';
import { engine } from '../core/shared';
import { add, cross, scale } from '../core/vectors';
import type { Handlers } from '../input/pointer';
import { placeCrossHair } from '../link/cross-hair';
import { dragWindow, windowBack } from '../state/actions';
import * as store from '../state/store';
import { useAsked } from './asked';
import { EdgeLabels } from './EdgeLabels';
import { FlatPicture } from './FlatPicture';
import {
  AXES,
  fittedLook,
  type Look,
  pannedLook,
  pixelOn,
  planeOf,
  pointOn,
  resizedLook,
  type SliceName,
  sliceDistance,
  zoomedLook,
} from './planes';
import { HairLines } from './TurningOverlay';

export function SliceView({ name }: { readonly name: SliceName }) {
  const volume = store.report.value?.volume ?? null;
  const point = store.crossHair.value?.point ?? null;
  const window = store.window_.value;
  const [look, setLook] = useState<Look | null>(null);
  const [size, setSize] = useState<Pair | null>(null);

  useEffect(() => {
    setLook(volume && size ? fittedLook(volume, name, size) : null);
  }, [volume, name, Boolean(size), store.resets.value]);

  const before = useRef<Pair | null>(null);
  useEffect(() => {
    const from = before.current;
    before.current = size;
    if (from && size) {
      setLook((seen) => seen && resizedLook(seen, from, size));
    }
  }, [size]);

  const plane = look && point && size ? planeOf(name, look, point, size) : null;
  const ask = useAsked(plane, window);
  return (
    <FlatPicture
      name={name}
      words={`${name} slice`}
      ask={ask}
      handlers={sliceHandlers(name, look, setLook, plane)}
      onSize={setSize}
    >
      {plane && point && (
        <>
          <EdgeLabels {...AXES[name]} size={plane.size} spacing={plane.pixel_spacing} />
          <HairLines at={pixelOn(plane, point)} />
        </>
      )}
    </FlatPicture>
  );
}

function sliceHandlers(
  name: SliceName,
  look: Look | null,
  setLook: (look: Look) => void,
  plane: Plane | null,
): Handlers {
  const point = (at: Pair) => {
    if (plane) {
      void engine.at(pointOn(plane, at)).then((pick) => placeCrossHair(pick, name));
    }
  };
  const window = windowBack();
  return {
    drag: (action, by) => {
      if (action === 'window') {
        dragWindow(by);
      } else if (action === 'pan' && look) {
        setLook(pannedLook(look, name, by));
      }
    },
    zoom: (factor, at) => {
      if (look && plane) {
        setLook(zoomedLook(look, plane, factor, at));
      }
    },
    scroll: (steps) => scrollSlices(name, steps),
    click: (action, at) => {
      if (action === 'maximise') {
        store.maximised.value = store.maximised.value === name ? null : name;
      } else {
        point(at);
      }
    },
    hover: (at, shift) => {
      if (shift) {
        point(at);
      }
    },
    ...window,
    begin: () => {
      window.begin();
      atFirst[name] = look;
    },
    putBack: () => {
      window.putBack();
      const kept = atFirst[name];
      if (kept) {
        setLook(kept);
      }
    },
  };
}

/** Where the slices were looked at as the drag began that is under way, so that Escape puts it back. */
const atFirst: Partial<Record<SliceName, Look | null>> = {};

/** Moves the cross-hair by slices: downwards on the wheel goes towards the feet, the back and the right. */
function scrollSlices(name: SliceName, steps: number): void {
  const [volume, hair] = [store.report.value?.volume, store.crossHair.value];
  if (volume && hair) {
    const { right, down } = AXES[name];
    const normal = cross(right, down);
    const away = name === 'coronal' ? 1 : -1;
    const step = scale(normal, steps * away * sliceDistance(volume, name));
    void engine.at(add(hair.point, step)).then((pick) => placeCrossHair(pick, name));
  }
}
