/** View of the picked vessel in a reformation other than the straightened CPR. */

import { useCallback, useEffect, useRef, useState } from 'preact/hooks';
import { Failure } from '../core/failure';
import type { Pair, Picture, Reformation, ReformedPicture, Side } from '../core/messages';
import { currentVessel } from '../measure/current';
import { savePane } from '../output/pane-picture';
import { attempt } from '../output/save-actions';
import { FlatPicture } from '../pane/FlatPicture';
import { ReformationControls } from '../pane/ReformationControls';
import { dragWindow, windowBack } from '../state/actions';
import { moveAlong, placeAnswer } from '../state/cross-hair';
import { toggleMaximised } from '../state/panels';
import { profiles } from '../state/profiles';
import {
  lensOf,
  looksBack,
  mapOf,
  reformationOf,
  reformationTitle,
  setUncurled,
  uncurled,
} from '../state/reformation';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { NamedScale } from './NamedScale';
import { apart, LETTER, type PlacedName } from './names-apart';
import { HairLines } from './TurningOverlay';

/** Empty picture, shown if the reformation failed. */
const NO_PICTURE = (): Picture => ({ size: [1, 1], bytes: new Uint8ClampedArray(4) });

export function ReformedView({ kind }: { readonly kind: Reformation['kind'] }) {
  const [size, setSize] = useState<Pair | null>(null);
  const [shown, setShown] = useState<ReformedPicture | null>(null);
  const [refused, setRefused] = useState('');
  const side = useSide();
  const message = reformationOf(kind, {
    vessel: store.pickedVessel.value,
    side,
    angle: store.cprAngle.value,
    amount: uncurled.value,
    of: mapOf.value,
    at: store.pickedPlace.value,
    lens: lensOf.value,
    backwards: looksBack.value,
  });
  const window = store.window_.value;
  const text = message && JSON.stringify(message);
  const ask = useCallback(
    async (pane: Pair) => {
      try {
        const reformation = JSON.parse(text ?? '{}') as Reformation;
        const picture = await engine.ask('reformed', { reformation, size: pane, window });
        setRefused('');
        setShown(picture);
        return picture;
      } catch (error) {
        const failure = Failure.of(error);
        if (failure.kind === 'device' || failure.kind === 'interrupted') {
          throw failure;
        }
        setShown(null);
        setRefused(failure.message);
        return NO_PICTURE();
      }
    },
    [text, window, store.report.value?.vessels, kind === 'network' && profiles.value],
  );
  const [left, top] = size && shown ? begin(size, shown.size) : [0, 0];
  const hair = useHair(shown);
  return (
    <div class="reformed">
      <p class="axes" title={shown?.words}>
        {text && shown?.words}
      </p>
      <div class="reformed-picture">
        <FlatPicture
          name="straightened"
          words={reformationTitle()}
          ask={text ? ask : null}
          label={`${store.pickedLine()} ${mapOf.value}`}
          handlers={handlersOf(kind, [left, top])}
          empty="The reformation appears here once there is a vessel."
          onSize={setSize}
          style={{ margin: `${top}px 0 0 ${left}px` }}
        >
          {refused && <p class="nothing-yet">{refused}</p>}
          {text &&
            namesOf(shown, [left, top]).map(({ words, at: [x, y] }) => (
              <b key={`${words} ${x} ${y}`} class="name-in-map" style={{ left: `${x}px`, top: `${y}px` }}>
                {words}
              </b>
            ))}
          {text && size && shown && (
            <NamedScale
              size={size}
              spacing={kind === 'endoscopy' ? null : shown.pixel_spacing}
              isNamed={kind !== 'untangled' && kind !== 'network'}
            />
          )}
          {text && hair && <HairLines at={[hair[0] + left + 0.5, hair[1] + top + 0.5]} />}
        </FlatPicture>
      </div>
      <div class="pane-controls">
        <ReformationControls kind={kind} />
        {shown && (
          <button
            type="button"
            onClick={() =>
              attempt(() => savePane('straightened', isCpr(kind) ? `${kind}-cpr` : kind, shown.words))
            }
          >
            Save picture
          </button>
        )}
      </div>
    </div>
  );
}

/** The names in the picture, none over another one or over the name of the vessel at the top. */
function namesOf(shown: ReformedPicture | null, [left, top]: Pair): readonly PlacedName[] {
  const names = (shown?.marks ?? []).map(({ words, pixel: [x, y] }) => ({
    words,
    at: [x + left, y + top] as const,
  }));
  const title = currentVessel.value?.name ?? '';
  return apart(names, [{ words: title, at: [(LETTER[0] * title.length) / 2, LETTER[1] / 2] }]);
}

const begin = (pane: Pair, picture: Pair): Pair => [
  Math.floor((pane[0] - picture[0]) / 2),
  Math.floor((pane[1] - picture[1]) / 2),
];

/** Direction of the turning view while it rests; the reformation is not updated while the view turns. */
function useSide(): Side | null {
  const kept = useRef<Side | null>(null);
  const camera = store.completeCamera.value ?? (kept.current ? null : store.camera.value);
  if (camera) {
    kept.current = { direction: camera.direction, up: camera.up };
  }
  return kept.current;
}

/** Pixel of the cross-hair in the picture; null if it lies outside. */
function useHair(shown: ReformedPicture | null): Pair | null {
  const point = store.crossHair.value?.point ?? null;
  const [hair, setHair] = useState<Pair | null>(null);
  useEffect(() => {
    let isWanted = true;
    if (!point || !shown) {
      setHair(null);
      return;
    }
    // The study may have been closed meanwhile.
    const showHair = (place: Pair | null) => isWanted && setHair(place);
    void engine.ask('on_reformed', point).then(showHair, () => showHair(null));
    return () => {
      isWanted = false;
    };
  }, [point, shown]);
  return hair;
}

const isCpr = (kind: Reformation['kind']) => kind !== 'network' && kind !== 'endoscopy';

function handlersOf(kind: Reformation['kind'], [left, top]: Pair) {
  const point = ([x, y]: Pair) =>
    attempt(() => {
      const pixel: Pair = [x - left - 0.5, y - top - 0.5];
      // The eye of an endoscopy stays in its section.
      const from = kind === 'endoscopy' ? 'section' : 'straightened';
      return placeAnswer(engine.ask('pick_reformed', { pixel }), from);
    });
  return {
    drag: (action: string, by: Pair) => (action === 'window' ? dragWindow(by) : undefined),
    zoom: () => undefined,
    scroll: (steps: number) => {
      if (kind === 'uncurl') {
        setUncurled(uncurled.value + steps * 0.02);
      } else if (kind === 'endoscopy') {
        moveAlong(looksBack.value ? -steps : steps);
      } else {
        store.turnCpr(steps);
      }
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
}
