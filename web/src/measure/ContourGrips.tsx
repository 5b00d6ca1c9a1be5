/** Grips of a section's contour, and the buttons that show them and return to the automatic contour. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { DrawnContour, LineId, Pair, Plane } from '../core/messages';
import { pixelOn, pointOn } from '../core/planes';
import { drawContour, removeContour } from '../edit/vessels';
import { Handle } from '../pane/Handle';
import { isDrawingContour, pullContour, pulledContour, showGrips } from '../state/contour';
import { recover } from '../state/device';
import { pickedId } from '../state/shown';
import { engine } from '../worker/engine';
import { unlessGone } from './asking';
import { currentProfile, currentVessel } from './current';

/** Number of contour points from one grip to the next. */
const GRIP_STEP = 4;
const COLOR = '#b4ff39';

interface ContourGripsProps {
  readonly plane: Plane;
  /** Arc length of the section (mm). */
  readonly at: number;
  readonly isByHand: boolean;
}

export function ContourGrips({ plane, at, isByHand }: ContourGripsProps) {
  const line = currentVessel.value?.line;
  const isDrawing = isDrawingContour.value;
  useEffect(() => () => void showGrips(false), []);
  const id = pickedId();
  return (
    <>
      <div class="contour-tools">
        <button
          type="button"
          class="small"
          aria-pressed={isDrawing}
          title="Shows grips on the contour. A drag pulls the contour; it then counts as drawn by hand"
          onClick={() => showGrips(!isDrawing)}
        >
          Edit contour
        </button>
        {isByHand && id !== null && (
          <button
            type="button"
            class="small"
            title="Removes the contour by hand, so that the automatic one counts again"
            onClick={() => void removeContour(id, at)}
          >
            Automatic
          </button>
        )}
      </div>
      {isDrawing && line !== undefined && <Grips plane={plane} at={at} line={line} />}
    </>
  );
}

interface Still {
  readonly line: LineId;
  readonly drawn: DrawnContour;
}

interface GripsProps {
  readonly plane: Plane;
  readonly at: number;
  readonly line: LineId;
}

function Grips({ plane, at, line }: GripsProps) {
  const profile = currentProfile.value;
  const [still, setStill] = useState<Still | null>(null);
  const latest = useRef(new Latest());
  const begun = useRef<DrawnContour | null>(null);
  const last = useRef<Pair | null>(null);
  useEffect(() => {
    latest.current.run(async () => {
      const message = { line, at, contour: null, to: null };
      const drawn = await engine.ask('drawn_contour', message).catch(unlessGone);
      pullContour(null);
      setStill(drawn && { line, drawn });
    });
  }, [line, at, profile]);
  const shown = pulledContour.value ?? still?.drawn;
  if (!shown || still?.line !== line || shown.contour[0] !== at) {
    return null;
  }
  const follow = async () => {
    const [from, pixel] = [begun.current, last.current];
    if (from && pixel) {
      const message = { line, at, contour: from.contour, to: pointOn(plane, pixel) };
      const pulled = await engine.ask('drawn_contour', message).catch(recover);
      // Escape may have ended the drag meanwhile.
      if (pulled && begun.current === from) {
        pullContour(pulled);
      }
    }
  };
  const pull = (pixel: Pair) => {
    last.current = pixel;
    latest.current.run(follow);
  };
  // The end of a drag replaces a pull that has not been performed yet.
  const end = () =>
    latest.current.run(async () => {
      await follow();
      const [id, pulled] = [pickedId(), pulledContour.value];
      if (begun.current && pulled && id !== null && !(await drawContour(id, pulled.contour))) {
        pullContour(null);
      }
    });
  const putBack = () => {
    begun.current = null;
    pullContour(null);
  };
  return (
    <>
      {shown.points
        .filter((_, number) => number % GRIP_STEP === 0)
        .map((point, n) => {
          const pixel = pixelOn(plane, point);
          return (
            <Handle
              key={n}
              at={pixel}
              words={`Grip ${n + 1} of the contour`}
              color={COLOR}
              kind="grip"
              onBegin={() => {
                begun.current = shown;
                last.current = null;
              }}
              onDrag={pull}
              onArrow={([x, y]) => pull([pixel[0] + x, pixel[1] + y])}
              onEnd={end}
              onPutBack={putBack}
            />
          );
        })}
    </>
  );
}
