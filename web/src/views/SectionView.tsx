import { useEffect, useState } from 'preact/hooks';
import type { Answer, LineId, Pair, Plane } from '../core/messages';
import { pixelOn, pointOn } from '../core/planes';
import { currentProfile } from '../measure/current';
import { SliceMeasures } from '../measure/MeasureOverlay';
import { SectionMarks } from '../measure/SectionMarks';
import { snapped } from '../measure/sections';
import { FlatPicture } from '../pane/FlatPicture';
import { PlayButton } from '../pane/PlayButton';
import { dragWindow, windowBack } from '../state/actions';
import { moveAlong, moveCrossHair } from '../state/cross-hair';
import { recover } from '../state/device';
import { toggleMaximised } from '../state/panels';
import * as store from '../state/store';
import { pickedLine } from '../state/store';
import { engine } from '../worker/engine';
import { useAsked } from './asked';
import { EdgeLabels } from './EdgeLabels';
import { LineGrips } from './LineGrips';
import { ofPlane } from './projection';
import { HairLines } from './TurningOverlay';

/** Width and height shown at first (mm). */
const FIRST_SIDE = 50;
/** Movement along the vessel per step of the wheel (mm). */
const STEP = 0.5;

interface Frame extends Pick<Plane, 'center' | 'right' | 'down'> {
  readonly line: LineId | null;
  readonly at: number;
}

const planeOf = ({ center, right, down }: Frame, size: Pair, side: number): Plane => ({
  ...{ center, right, down, size },
  pixel_spacing: side / Math.min(...size),
});

export function SectionView() {
  const vessel = store.pickedVessel.value;
  const at = store.pickedPlace.value;
  const line = pickedLine();
  const profile = currentProfile.value;
  const window = store.window_.value;
  const volume = store.report.value?.volume;
  const [size, setSize] = useState<Pair | null>(null);
  const [side, setSide] = useState(FIRST_SIDE);
  const [frame, setFrame] = useState<Frame | null>(null);

  useEffect(() => {
    if (vessel === null) {
      setFrame(null);
    } else {
      const show = ([center, right, down]: Answer<'across'>) => setFrame({ center, right, down, line, at });
      engine.ask('across', { vessel, at }).then(show, (error) => {
        // Ignore the error if the vessel has been retraced or another one picked.
        if (line === pickedLine()) {
          recover(error);
        }
      });
    }
    // If the vessel is measured, the plane of the measured section is shown, since it contains the contour.
  }, [vessel, at, line, profile]);

  const plane = frame && size ? planeOf(frame, size, side) : null;
  const ask = useAsked(plane, window);
  const isLate = frame !== null && (frame.line !== line || frame.at !== at);
  const point = (place: Pair) => {
    if (plane) {
      moveCrossHair(pointOn(plane, place), 'section');
    }
  };
  const handlers = {
    drag: (action: string, by: Pair) => (action === 'window' ? dragWindow(by) : undefined),
    zoom: (factor: number) => setSide((before) => Math.min(Math.max(before / factor, 2), 500)),
    scroll: (steps: number) => moveAlong(steps * STEP),
    click: (action: string, place: Pair) => {
      if (action === 'maximise') {
        toggleMaximised('section');
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
      label={frame ? `${frame.line} ${frame.at}` : ''}
      isLate={isLate}
      empty="The section across the vessel appears here once there is a vessel."
      onSize={setSize}
    >
      {plane && (
        <>
          <EdgeLabels right={plane.right} down={plane.down} size={plane.size} spacing={plane.pixel_spacing} />
          <SectionMarks plane={plane} />
          <div class="section-play">
            <PlayButton kind="sections" />
          </div>
          <SliceMeasures plane={plane} where="in the section" />
          {hair && <HairLines at={pixelOn(plane, hair.point)} />}
          {volume && frame && !isLate && (
            <LineGrips
              projection={ofPlane(plane, volume)}
              only={{ at: profile ? snapped(profile, frame.at) : frame.at, point: frame.center }}
            />
          )}
        </>
      )}
    </FlatPicture>
  );
}
