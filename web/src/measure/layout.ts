/** Layout of the measuring pane, which the engine computes (CSS pixels), and its linear axes. */

import { useEffect, useRef, useState } from 'preact/hooks';
import { Latest } from '../core/latest';
import type { Axis, LineId, MeasureLayout, Pair } from '../core/messages';
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

/** The value at a pixel, clamped to the axis. */
export function valueAt({ low, high, start, end }: Axis, pixel: number): number {
  const value = low + ((pixel - start) / (end - start)) * (high - low);
  return Math.min(Math.max(value, low), high);
}
