/** Straightened CPR of the picked vessel, shown horizontally with its first point on the left. */

import { useCallback, useState } from 'preact/hooks';
import type { Axis, Cpr, Pair, StripLayout } from '../core/messages';
import { CprControls } from '../pane/CprControls';
import { FlatPicture } from '../pane/FlatPicture';
import { dragWindow, windowBack } from '../state/actions';
import { moveTo } from '../state/cross-hair';
import { toggleMaximised } from '../state/panels';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { lyingBox, lyingPicture, valueAt } from './layout';

interface LyingCprProps {
  readonly x: Axis;
  readonly lying: StripLayout;
  readonly height: number;
}

export function LyingCpr({ x, lying, height }: LyingCprProps) {
  const vessel = store.pickedVessel.value;
  const window = store.window_.value;
  const cpr: Cpr | null = vessel === null ? null : cprOf(vessel, lying);
  const text = cpr && JSON.stringify(cpr);
  const [shown, setShown] = useState<Pair | null>(null);
  const ask = useCallback(async () => {
    const picture = lyingPicture(
      await engine.ask('straightened', { cpr: JSON.parse(text ?? '{}') as Cpr, window }),
    );
    setShown(picture.size);
    return picture;
  }, [text, window, store.pickedLine()]);
  const box = lyingBox(x, lying, shown ?? [1, 1]);
  return (
    <div class="lying" style={{ height: `${height}px` }}>
      <FlatPicture
        name="profile"
        words="picked vessel, straightened, its first point on the left"
        ask={text ? ask : null}
        label={`${store.pickedLine()} ${store.cprFeature.value}`}
        handlers={handlersOf(x)}
        style={pixels(box)}
      />
      {Math.abs(lying.stretch - 1) > 0.01 && (
        <span
          class="stretched"
          title="The picture is stretched across the vessel by this factor"
        >{`height × ${lying.stretch.toPrecision(2)}`}</span>
      )}
      <CprControls />
    </div>
  );
}

const cprOf = (vessel: number, { width, spacing }: StripLayout): Cpr => ({
  vessel,
  angle: store.cprAngle.value,
  width,
  pixel_spacing: spacing,
  feature: store.cprFeature.value,
  roll: store.cprRoll.value,
});

function pixels(box: Readonly<Record<string, number>>): Record<string, string> {
  const lengths = Object.entries(box).map(([name, length]) => [name, `${length}px`] as const);
  return { position: 'absolute', ...Object.fromEntries(lengths) };
}

function handlersOf(x: Axis) {
  return {
    drag: (action: string, by: Pair) => (action === 'window' ? dragWindow(by) : undefined),
    zoom: () => undefined,
    scroll: (steps: number) => {
      store.turnCpr(steps);
    },
    click: (action: string, [column]: Pair) => {
      if (action === 'maximise') {
        toggleMaximised('profile');
      } else {
        moveTo(valueAt(x, column));
      }
    },
    hover: ([column]: Pair, shift: boolean) => (shift ? moveTo(valueAt(x, column)) : undefined),
    ...windowBack(),
  };
}
