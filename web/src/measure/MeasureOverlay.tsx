/** Draws marked places and rulers over the turning view and the slices. */

import { pixelOf } from '../core/camera';
import type { Camera, Pair, Plane, Vector } from '../core/messages';
import { pixelOn, pointOn } from '../core/planes';
import { cross, dot, subtract } from '../core/vectors';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { currentProfile } from './current';
import { PlaceHandles } from './PlaceHandles';
import { RulerLayer } from './Rulers';
import { centerAt, seenNearest } from './sections';

/** Points within this distance of a slice (mm) count as lying in it. */
const IN_SLICE = 1;

export function TurningMeasures({ camera }: { readonly camera: Camera }) {
  const profile = currentProfile.value;
  const seen = (point: Vector) => pixelOf(camera, point);
  const pointAt = async (pixel: Pair) => {
    const view = { camera, method: store.method.value, settings: store.viewSettings.value };
    return (await engine.ask('pick', { view, pixel })).point;
  };
  return (
    <>
      {profile && (
        <PlaceHandles
          view="on the vessel"
          pixelAt={(at) => {
            const center = centerAt(profile, at);
            return center && seen(center);
          }}
          atOf={(pixel, before) => seenNearest(profile, seen, pixel, before)}
        />
      )}
      <RulerLayer
        seen={{
          where: 'on the vessels',
          pixelOf: seen,
          pointAt,
          isSeen: (point) => isWithin(seen(point), camera.size),
        }}
      />
    </>
  );
}

interface SliceMeasuresProps {
  readonly plane: Plane;
  /** Words for the view in labels, such as `in the section`. */
  readonly where: string;
}

export function SliceMeasures({ plane, where }: SliceMeasuresProps) {
  const normal = cross(plane.right, plane.down);
  const isSeen = (point: Vector) => Math.abs(dot(subtract(point, plane.center), normal)) <= IN_SLICE;
  return (
    <RulerLayer
      seen={{
        where,
        pixelOf: (point) => pixelOn(plane, point),
        pointAt: async (pixel) => pointOn(plane, pixel),
        isSeen,
      }}
    />
  );
}

const isWithin = ([x, y]: Pair, [width, height]: Pair): boolean =>
  x >= 0 && y >= 0 && x < width && y < height;
