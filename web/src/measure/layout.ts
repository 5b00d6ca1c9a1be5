/** Layout of the measuring pane, which the engine computes (CSS pixels), its linear axes, and its horizontal picture. */
import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { Axis, LineId, MeasureLayout, Pair, Picture, StripLayout } from '../core/messages';
import { recover } from '../state/device';
import { engine } from '../worker/engine';
import { unlessGone } from './asking';
import { currentProfile, currentVessel } from './current';
import { TOOLS } from './SectionTools';

interface Laid {
  readonly line: LineId;
  readonly layout: MeasureLayout;
}

/** The layout for the picked vessel; until a new layout is computed, the previous one of this vessel. */
export function useMeasureLayout(size: Pair | null): MeasureLayout | null {
  const line = currentVessel.value?.line ?? null;
  const profile = currentProfile.value;
  const [laid, setLaid] = useState<Laid | null>(null);
  const latest = useRef(new Latest());
  const density = Math.min(window.devicePixelRatio || 1, 2);
  useEffect(() => {
    if (line === null || !size) {
      return;
    }
    const pane = { line, is_measured: profile !== null, size, between: TOOLS, density };
    latest.current.run(async () => {
      const layout = await engine.ask('measure_layout', pane).catch(unlessGone).catch(recover);
      if (layout) {
        setLaid({ line, layout });
      }
    });
  }, [line, profile, size, density]);
  return laid?.line === line ? laid.layout : null;
}

export function pixelAt({ low, high, start, end }: Axis, value: number): number {
  return start + ((value - low) / (high - low)) * (end - start);
}

export function valueAt({ low, high, start, end }: Axis, pixel: number): number {
  const value = low + ((pixel - start) / (end - start)) * (high - low);
  return Math.min(Math.max(value, low), high);
}

/** Picture of the straightened vessel, turned so that its first point is on the left. */
export function lyingPicture({ size: [width, height], bytes }: Picture): Picture {
  const from = new Uint32Array(bytes.buffer, bytes.byteOffset, width * height);
  const to = new Uint32Array(width * height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      to[(width - 1 - column) * height + row] = from[row * width + column] ?? 0;
    }
  }
  return { size: [height, width], bytes: new Uint8ClampedArray(to.buffer) };
}

/** Box of the picture: the centre of column `n` is at arc length `n` × spacing. */
export function lyingBox(x: Axis, { spacing, height, width }: StripLayout, [columns, rows]: Pair) {
  const perMm = (x.end - x.start) / (x.high - x.low);
  const pixel = spacing * perMm;
  const tall = (rows * spacing * height) / width;
  return { left: x.start - pixel / 2, top: (height - tall) / 2, width: columns * pixel, height: tall };
}
