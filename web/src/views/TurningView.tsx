/** The main view, which shows the vessels cut open and can be turned freely. */

import { useSignalEffect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { resized, zoomed } from '../core/camera';
import type { Pair, Picture, Settings, Vector, View } from '../core/messages';
import { cross } from '../core/vectors';
import type { Action } from '../input/bindings';
import { dragOfKey, zoomOfKey } from '../input/keys';
import { listen } from '../input/pointer';
import { withRim } from '../measure/rim';
import { usePaneSize } from '../pane/pane-size';
import * as actions from '../state/actions';
import { everyFrame } from '../state/cine';
import { placeAnswer } from '../state/cross-hair';
import { recover } from '../state/device';
import { isDark } from '../state/kind';
import { stepLumen } from '../state/lumens';
import { toggleMaximised } from '../state/panels';
import * as store from '../state/store';
import { isTracing } from '../state/tool';
import { engine } from '../worker/engine';
import { FrameLoop, type Shown } from './frame-loop';
import { ofCamera } from './projection';
import { TurningOverlay } from './TurningOverlay';
import { clickWithTool, followPointerAt, forgetPointer, type Pointed, toolRows } from './tool-clicks';

/** Speed of the slow rotation (radians per second). */
const TURN_PER_SECOND = 0.5;

export function TurningView() {
  const pane = useRef<HTMLDivElement>(null);
  const loop = useRef<FrameLoop | null>(null);
  const size = usePaneSize(pane);
  const epoch = store.epoch.value;
  const canvas = useRef<HTMLCanvasElement>(null);

  useEffect(() => {
    const frames = new FrameLoop((shown) => showFrame(canvas.current, shown), recover);
    loop.current = frames;
    return () => frames.end();
  }, []);

  useEffect(() => {
    const element = canvas.current;
    if (element && store.started.value?.isGpu) {
      handedOver.add(element);
      const handed = engine.drawOn(element.transferControlToOffscreen());
      void handed.then(() => loop.current?.again(), recover);
      // After the loss the canvas is black. Rendering the next frame fails, which starts the recovery.
      void engine.loss().then(() => loop.current?.again(), recover);
    } else {
      loop.current?.again();
    }
  }, [epoch]);

  useEffect(() => {
    const camera = store.camera.value;
    if (camera && size && (camera.size[0] !== size[0] || camera.size[1] !== size[1])) {
      store.setCamera(resized(camera, size));
    }
  }, [size, store.report.value]);

  useSignalEffect(() => {
    const view = wantedView();
    if (view) {
      if (canvas.current) {
        canvas.current.dataset.stage = 'wanted';
        canvas.current.dataset.last = 'false';
      }
      loop.current?.want(view);
    }
  });

  useSignalEffect(() =>
    store.isTurning.value
      ? everyFrame((seconds) => actions.turnSlowly(TURN_PER_SECOND * seconds))
      : undefined,
  );

  useEffect(() => {
    const element = pane.current;
    return element ? listen(element, 'turning', handlers) : undefined;
  }, []);

  return (
    <div
      class="pane-body"
      ref={pane}
      data-testid="turning"
      role="application"
      aria-label="vessels, cut open"
      tabIndex={0}
      onKeyDown={pressed}
    >
      <canvas key={epoch} ref={canvas} class={store.isInverted.value ? 'picture inverted' : 'picture'} />
      <TurningOverlay />
    </div>
  );
}

function wantedView(): View | null {
  const [camera, report] = [store.camera.value, store.report.value];
  if (!camera || !report?.volume || camera.size[0] < 2 || camera.size[1] < 2) {
    return null;
  }
  const settings = store.viewSettings.value;
  // While tracing, a projection is shown, since a cut would hide vessels that are not traced yet.
  return isTracing()
    ? {
        camera,
        method: 'csr',
        settings: { ...settings, ...projected(), window: settings.context_window ?? store.window_.value },
      }
    : withRim({ camera, method: store.method.value, settings });
}

/** Maximum intensity projection of the whole scan: a slab of 1000 mm. For dark lumens it is thin, since air is as dark. */
const projected = (): Settings => ({ slab: isDark.value ? [60, 'min'] : [1000, 'max'], silhouettes: false });

const handedOver = new WeakSet<HTMLCanvasElement>();

function showFrame(canvas: HTMLCanvasElement | null, { drawn, stage, view, wanted, isLast }: Shown): void {
  // The frame was rendered before the canvas was handed over to the worker, so it must be rendered again.
  if (canvas && drawn.picture && handedOver.has(canvas)) {
    return;
  }
  // The time of a supersampled picture says nothing about the frame rate.
  if (stage !== 'samples') {
    store.setFrameTime(drawn.milliseconds);
  }
  if (canvas && drawn.picture) {
    paint(canvas, drawn.picture);
  }
  if (canvas) {
    canvas.dataset.stage = stage;
    canvas.dataset.last = String(isLast);
    canvas.dataset.pixels = view.camera.size.join('x');
  }
  store.setCompleteCamera(stage === 'moving' ? null : wanted.camera);
}

function paint(canvas: HTMLCanvasElement, picture: Picture): void {
  const [width, height] = picture.size;
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  canvas.getContext('2d')?.putImageData(new ImageData(picture.bytes, width, height), 0, 0);
}

/** Arrow keys rotate, with Shift they pan; + and - zoom. */
function pressed(event: KeyboardEvent): void {
  if (event.target !== event.currentTarget) {
    return;
  }
  const by = dragOfKey(event.key);
  const factor = zoomOfKey(event.key);
  if (by) {
    event.preventDefault();
    actions.dragTurning(event.shiftKey ? 'pan' : 'rotate', by, null);
  } else if (factor) {
    actions.changeCamera((camera) => zoomed(camera, factor));
  }
}

/** Direction of the picked vessel at the cross-hair, for rotation about it; null without a vessel. */
let vesselAxis: Vector | null = null;

const dragged = actions.windowBack();

const handlers = {
  drag: (action: Parameters<typeof actions.dragTurning>[0], by: readonly [number, number]) =>
    actions.dragTurning(action, by, vesselAxis),
  zoom: actions.zoomTurning,
  scroll: () => undefined,
  rows: toolRows,
  step: (by: number) => void stepLumen(by),
  leave: forgetPointer,
  click: (action: Action, at: Pair) => {
    const view = pointed();
    if (view && clickWithTool(view, action, at)) {
      return;
    }
    if (action === 'maximise') {
      toggleMaximised('turning');
    } else {
      void pickAt(at);
    }
  },
  hover: (at: Pair, shift: boolean) => {
    if (shift) {
      void pickAt(at);
    }
    const view = pointed();
    if (view) {
      followPointerAt(view, at);
    }
  },
  ...dragged,
  begin: () => {
    dragged.begin();
    void findAxis();
  },
};

/** How the tracing tools find points in this view: at the brightest voxel on the ray. */
function pointed(): Pointed | null {
  const [view, volume] = [wantedView(), store.report.value?.volume];
  return view && volume
    ? {
        name: 'turning',
        projection: ofCamera(view.camera, volume),
        place: (at) => engine.ask('brightest', { view, pixel: at }),
      }
    : null;
}

async function findAxis(): Promise<void> {
  const vessel = store.pickedVessel.value;
  if (vessel === null) {
    vesselAxis = null;
    return;
  }
  const [, right, down] = await engine.ask('across', { vessel, at: store.pickedPlace.value });
  vesselAxis = cross(right, down);
}

let isPicking = false;

async function pickAt(at: readonly [number, number]): Promise<void> {
  const view = wantedView();
  if (!view || isPicking) {
    return;
  }
  isPicking = true;
  try {
    await placeAnswer(engine.ask('pick', { view, pixel: at }), 'turning');
  } catch (error) {
    recover(error);
  } finally {
    isPicking = false;
  }
}
