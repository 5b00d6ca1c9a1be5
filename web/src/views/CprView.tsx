/** The straightened CPR of the picked vessel. */
import { useCallback, useState } from 'preact/hooks';
import type { Cpr, Feature, Pair } from '../core/messages';
import { engine } from '../core/shared';
import { placeCrossHair } from '../link/cross-hair';
import { dragWindow, windowBack } from '../state/actions';
import * as store from '../state/store';
import { FlatPicture } from './FlatPicture';

/** The width that is shown (mm). */
const WIDTH = 50;
/** The rotation of one step of the wheel (radians), and of a drag of one pixel. */
const STEP = Math.PI / 36;

export function CprView() {
  const vessel = store.pickedVessel.value;
  const angle = store.cprAngle.value;
  const feature = store.cprFeature.value;
  const window = store.window_.value;
  const [size, setSize] = useState<Pair | null>(null);
  const length = vessel === null ? 0 : (store.report.value?.vessels?.[vessel]?.length ?? 0);
  const spacing = size && length > 0 ? Math.max(length / size[1], 0.05) : null;
  const cpr: Cpr | null =
    vessel !== null && spacing && size
      ? { vessel, angle, width: Math.min(WIDTH, size[0] * spacing), pixel_spacing: spacing, feature }
      : null;
  const text = cpr && JSON.stringify(cpr);
  const [shown, setShown] = useState<Pair | null>(null);
  const ask = useCallback(async () => {
    const picture = await engine.straightened(JSON.parse(text ?? '{}') as Cpr, window);
    setShown(picture.size);
    return picture;
  }, [text, window]);

  const left = size && shown ? (size[0] - shown[0]) / 2 : 0;
  const point = (at: Pair) => {
    if (shown) {
      void engine
        .pickStraightened([at[0] - left, at[1]])
        .then((pick) => placeCrossHair(pick, 'straightened'));
    }
  };
  const handlers = {
    drag: (action: string, by: Pair) => (action === 'window' ? dragWindow(by) : undefined),
    zoom: () => undefined,
    scroll: (steps: number) => {
      store.cprAngle.value += steps * STEP;
    },
    click: (action: string, at: Pair) => {
      if (action === 'maximise') {
        store.maximised.value = store.maximised.value === 'straightened' ? null : 'straightened';
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
        handlers={handlers}
        onSize={setSize}
        style={{ margin: '0 auto' }}
      >
        {cpr && <div class="place-line" style={{ top: `${row}px` }} />}
      </FlatPicture>
      {cpr && <CprControls />}
    </>
  );
}

/** The rotation about the vessel, and which value a pixel shows. */
function CprControls() {
  const degrees = Math.round((store.cprAngle.value * 180) / Math.PI);
  return (
    <div class="pane-controls">
      <input
        type="range"
        min="-180"
        max="180"
        step="5"
        value={String(((((degrees + 180) % 360) + 360) % 360) - 180)}
        aria-label="Rotation about the vessel (degrees)"
        onInput={(event) => {
          store.cprAngle.value = (Number(event.currentTarget.value) * Math.PI) / 180;
        }}
      />
      <output>{`${degrees}°`}</output>
      <select
        aria-label="What a pixel shows"
        value={store.cprFeature.value ?? ''}
        onChange={(event) => {
          store.cprFeature.value = (event.currentTarget.value || null) as Feature | null;
        }}
      >
        <option value="">CPR</option>
        <option value="max">CFA, largest</option>
        <option value="mean">CFA, mean</option>
        <option value="min">CFA, smallest</option>
      </select>
    </div>
  );
}
