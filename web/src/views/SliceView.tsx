/** A slice through the cross-hair: axial, coronal or sagittal at first. */

import { batch } from '@preact/signals';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { Pair, Plane } from '../core/messages';
import {
  fittedLook,
  type Look,
  normalOf,
  pannedLook,
  pixelOn,
  planeOf,
  pointOn,
  resizedLook,
  type SliceName,
  turnedLook,
  voxelSide,
  zoomedLook,
} from '../core/planes';
import { add, scale } from '../core/vectors';
import type { Handlers } from '../input/pointer';
import { SliceMeasures } from '../measure/MeasureOverlay';
import { FlatPicture } from '../pane/FlatPicture';
import { dragWindow, windowBack } from '../state/actions';
import { moveCrossHair } from '../state/cross-hair';
import { aimAt } from '../state/drawing';
import { stepLumen } from '../state/lumens';
import { toggleMaximised } from '../state/panels';
import { areLinesShown, sliceWords, turnBySteps } from '../state/slices';
import * as store from '../state/store';
import { isTracing } from '../state/tool';
import { useAsked } from './asked';
import { EdgeLabels } from './EdgeLabels';
import { LineGrips } from './LineGrips';
import { LumenInset } from './LumenInset';
import { PlaneLines } from './PlaneLines';
import { ofPlane, type Projection } from './projection';
import { SliceTools } from './SliceTools';
import { TracedOverlay } from './TracedOverlay';
import { HairLines } from './TurningOverlay';
import { clickWithTool, followPointerAt, forgetPointer, toolRows } from './tool-clicks';

export function SliceView({ name }: { readonly name: SliceName }) {
  const volume = store.report.value?.volume ?? null;
  const point = store.crossHair.value?.point ?? null;
  const window = store.window_.value;
  const axes = store.slices.value[name];
  const { slab } = store.slices.value;
  const [before, setLook] = useState<Look | null>(null);
  const [size, setSize] = useState<Pair | null>(null);
  const look = before && point && turnedLook(before, axes, point);
  // The look keeps its turn, before the cross-hair moves.
  useLayoutEffect(() => setLook(look), [axes]);

  useEffect(() => {
    setLook(volume && size ? fittedLook(volume, axes, size) : null);
  }, [volume, name, Boolean(size), store.resets.value]);

  const sizeBefore = useRef<Pair | null>(null);
  useEffect(() => {
    const from = sizeBefore.current;
    sizeBefore.current = size;
    if (from && size) {
      setLook((seen) => seen && resizedLook(seen, from, size));
    }
  }, [size]);

  const plane = look && point && size ? { ...planeOf(look, point, size), slab } : null;
  const projection = plane && volume ? ofPlane(plane, volume) : null;
  const ask = useAsked(plane, window);
  return (
    <FlatPicture
      name={name}
      words={`${name} slice`}
      ask={ask}
      label={sliceWords(name)}
      handlers={sliceHandlers(name, look, setLook, plane, projection)}
      onSize={setSize}
      onArrow={projection && isTracing() ? (by) => stepCrossHair(name, projection, by) : undefined}
      onTurn={areLinesShown.value ? (steps) => turnBySteps(name, steps) : undefined}
    >
      {plane && point && (
        <>
          <EdgeLabels {...axes} size={plane.size} spacing={plane.pixel_spacing} />
          {projection && <TracedOverlay projection={projection} />}
          <SliceMeasures plane={plane} where={`in the ${name} slice`} />
          <HairLines at={pixelOn(plane, point)} />
          {!isTracing() && <PlaneLines name={name} plane={plane} point={point} />}
          {!isTracing() && <SliceTools />}
          {projection && !isTracing() && <LineGrips projection={projection} />}
          <LumenInset view={name} size={plane.size} />
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
  projection: Projection | null,
): Handlers {
  const point = (at: Pair) => {
    if (plane) {
      moveCrossHair(pointOn(plane, at), name);
    }
  };
  const pointed = plane && projection ? { name, projection, place: (at: Pair) => pointOn(plane, at) } : null;
  const window = windowBack();
  return {
    rows: toolRows,
    step: (by) => void stepLumen(by),
    leave: forgetPointer,
    drag: (action, by) => {
      if (action === 'window') {
        dragWindow(by);
      } else if (action === 'pan' && look) {
        setLook(pannedLook(look, by));
      }
    },
    zoom: (factor, at) => {
      if (look && plane) {
        setLook(zoomedLook(look, plane, factor, at));
      }
    },
    scroll: (steps) => scrollSlices(name, steps),
    click: (action, at) => {
      if (pointed && clickWithTool(pointed, action, at)) {
        return;
      }
      if (action === 'maximise') {
        toggleMaximised(name);
      } else {
        point(at);
      }
    },
    hover: (at, shift) => {
      if (shift) {
        point(at);
      }
      if (pointed) {
        followPointerAt(pointed, at);
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

/** Positions of the slice views before a drag, which Escape restores. */
const atFirst: Partial<Record<SliceName, Look | null>> = {};

/** Scrolls a slice. Turning the wheel down moves towards the feet, the back or the right of the patient. */
function scrollSlices(name: SliceName, steps: number): void {
  const [volume, hair] = [store.report.value?.volume, store.crossHair.value];
  if (volume && hair) {
    const normal = normalOf(store.slices.value[name]);
    const sign = name === 'coronal' ? 1 : -1;
    const step = scale(normal, steps * sign * voxelSide(volume, normal));
    moveCrossHair(add(hair.point, step), name);
  }
}

function stepCrossHair(name: SliceName, projection: Projection, by: Pair): void {
  const hair = store.crossHair.value;
  if (!hair) {
    return;
  }
  const point = add(hair.point, projection.step(by));
  batch(() => {
    moveCrossHair(point, name);
    aimAt(point);
  });
}
