/** Small picture of the lumen that a click would select: its section, its diameter and its value. */
import { useEffect, useRef } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { Pair, Plane, PointedLumen } from '../core/messages';
import { pointed } from '../state/lumens';
import { hasMillimetres } from '../state/millimetres';
import { isInverted, type ViewName, window_ } from '../state/store';
import { isTracing } from '../state/tool';
import { valueUnit } from '../state/value-unit';
import { engine } from '../worker/engine';

/** Side of the picture, and its distance from the pointer (CSS pixels). */
const SIDE = 120;
const POINTER_GAP_PX = 18;
const HEIGHT = SIDE + 60;

/** The picture shows this many lumen diameters, but at least a minimum width (mm). */
const DIAMETERS = 4;
const MIN_WIDTH_MM = 16;

export function LumenInset({ view, size }: { readonly view: ViewName; readonly size: Pair }) {
  const now = pointed.value;
  const lumen = now?.lumens[now.number];
  if (!now || !lumen || now.view !== view || !isTracing()) {
    return null;
  }
  const [x, y] = now.at;
  const beside = (at: number, own: number, all: number) =>
    at + POINTER_GAP_PX + own > all ? at - POINTER_GAP_PX - own : at + POINTER_GAP_PX;
  const style = { left: `${beside(x, SIDE, size[0])}px`, top: `${beside(y, HEIGHT, size[1])}px` };
  const count = now.lumens.length;
  return (
    <div class="lumen-inset" style={style} data-testid="lumen-inset" role="status">
      <Section lumen={lumen} />
      <span>
        lumen, {lumen.diameter.toFixed(1)}
        {hasMillimetres.value && ' mm'}
      </span>
      <span title="The median near the centre of the lumen; the line at the bottom shows the value at the cross-hair">
        median {Math.round(lumen.value)} {valueUnit()}
      </span>
      {count > 1 && (
        <span>
          {now.number + 1} of {count} · Alt+wheel
        </span>
      )}
    </div>
  );
}

function Section({ lumen }: { readonly lumen: PointedLumen }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const latest = useRef(new Latest());
  const window = window_.value;
  useEffect(() => {
    const { center, right, down, diameter } = lumen;
    const pixel_spacing = Math.max(DIAMETERS * diameter, MIN_WIDTH_MM) / SIDE;
    const plane: Plane = { center, right, down, size: [SIDE, SIDE], pixel_spacing };
    latest.current.run(async () => {
      const picture = await engine.ask('slice', { plane, window }).catch(() => null);
      const context = canvas.current?.getContext('2d');
      if (picture && context) {
        context.putImageData(new ImageData(picture.bytes, SIDE, SIDE), 0, 0);
      }
    });
  }, [lumen, window]);
  return (
    <canvas ref={canvas} class={isInverted.value ? 'inverted' : ''} width={SIDE} height={SIDE} aria-hidden />
  );
}
