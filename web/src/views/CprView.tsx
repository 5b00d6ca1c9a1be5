import { useCallback, useState } from 'preact/hooks';
import { DEFAULTS, PIXEL_SIDES } from '../core/generated/tables';
import type { Cpr, Pair } from '../core/messages';
import { UprightPlaces } from '../measure/PlaceHandles';
import { CprControls } from '../pane/CprControls';
import { FlatPicture } from '../pane/FlatPicture';
import { dragWindow, windowBack } from '../state/actions';
import { placeAnswer } from '../state/cross-hair';
import { toggleMaximised } from '../state/panels';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { CprGrips } from './CprGrips';
import { NamedScale } from './NamedScale';

export function CprView() {
  const vessel = store.pickedVessel.value;
  const angle = store.cprAngle.value;
  const feature = store.cprFeature.value;
  const roll = store.cprRoll.value;
  const window = store.window_.value;
  const [size, setSize] = useState<Pair | null>(null);
  const length = vessel === null ? 0 : (store.report.value?.vessels?.[vessel]?.length ?? 0);
  const spacing = size && length > 0 ? Math.max(length / size[1], PIXEL_SIDES[0]) : null;
  const cpr: Cpr | null =
    vessel !== null && spacing && size
      ? {
          vessel,
          angle,
          width: Math.min(DEFAULTS['cpr.width'], size[0] * spacing),
          pixel_spacing: spacing,
          feature,
          roll,
        }
      : null;
  const text = cpr && JSON.stringify(cpr);
  const [shown, setShown] = useState<Pair | null>(null);
  const ask = useCallback(async () => {
    const picture = await engine.ask('straightened', {
      cpr: JSON.parse(text ?? '{}') as Cpr,
      window,
    });
    setShown(picture.size);
    return picture;
  }, [text, window, store.pickedLine()]);

  const left = size && shown ? (size[0] - shown[0]) / 2 : 0;
  const point = (at: Pair) => {
    if (shown) {
      const pixel: Pair = [at[0] - left, at[1]];
      void placeAnswer(engine.ask('pick_straightened', { pixel }), 'straightened');
    }
  };
  const handlers = {
    drag: (action: string, by: Pair) => (action === 'window' ? dragWindow(by) : undefined),
    zoom: () => undefined,
    scroll: (steps: number) => {
      store.turnCpr(steps);
    },
    click: (action: string, at: Pair) => {
      if (action === 'maximise') {
        toggleMaximised('straightened');
      } else {
        point(at);
      }
    },
    hover: (at: Pair, shift: boolean) => (shift ? point(at) : undefined),
    ...windowBack(),
  };
  const row = spacing === null ? 0 : store.pickedPlace.value / spacing;
  return (
    <>
      <FlatPicture
        name="straightened"
        words="picked vessel, straightened"
        ask={text ? ask : null}
        label={`${store.pickedLine()} ${feature}`}
        handlers={handlers}
        empty="The straightened vessel appears here once there is a vessel."
        onSize={setSize}
        style={{ margin: '0 auto' }}
      >
        {cpr && size && spacing && <NamedScale size={size} spacing={spacing} />}
        {cpr && <div class="place-line" style={{ top: `${row}px` }} />}
        {size && spacing && <UprightPlaces size={size} spacing={spacing} />}
        {shown && spacing && <CprGrips size={shown} spacing={spacing} left={left} />}
      </FlatPicture>
      {cpr && <CprControls />}
    </>
  );
}
