/** The axis of values below a histogram. */
import type { Histogram, Window } from '../core/messages';

/** At most two window widths on each side of the level, so that metal does not compress the rest. */
export class Scale {
  readonly low: number;
  readonly high: number;

  constructor(
    histogram: Histogram,
    main: Window,
    private readonly size: readonly [number, number],
  ) {
    this.low = Math.max(histogram.low, main[0] - 2 * main[1]);
    this.high = Math.max(Math.min(histogram.high, main[0] + 2 * main[1]), this.low + 1e-3);
  }

  x(value: number): number {
    return Math.min(Math.max((value - this.low) / (this.high - this.low), 0), 1) * this.size[0];
  }

  get perPixel(): number {
    return (this.high - this.low) / this.size[0];
  }

  /** Outline of the histogram; its counts are logarithmic, because a few values dominate. */
  outline({ low, high, counts }: Histogram): string {
    const [width, height] = this.size;
    const most = Math.log1p(Math.max(...counts, 1));
    const step = (high - low) / counts.length;
    const points = counts.map((count, n) => {
      const x = this.x(low + (n + 0.5) * step).toFixed(1);
      return `${x} ${(height * (1 - Math.log1p(count) / most)).toFixed(1)}`;
    });
    return `M0 ${height}L${points.join('L')}L${width} ${height}Z`;
  }
}
