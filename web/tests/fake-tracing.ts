/** An engine in the place of the worker's, whose vessels are straight between clicks, and which notes what it is asked. */
import { Failure } from '../src/core/failure';
import type { Report, Vector } from '../src/core/messages';
import type { LineContent, NamedLine, TraceRequest, Tracing } from '../src/core/tracing';

/** Where the fake has no lumen: below this z (mm). */
export const FLOOR = -50;

export class FakeTracing implements Tracing {
  readonly lines: LineContent[] = [];
  readonly traces: TraceRequest[] = [];
  readonly shown: (readonly NamedLine[])[] = [];
  /** What a seed finds: why each branch is doubtful, or null. */
  branches: readonly (string | null)[] = [];
  /** Traces and trees wait for this. */
  gate: Promise<void> = Promise.resolve();

  async add(content: LineContent): Promise<number> {
    this.lines.push(content);
    return this.lines.length - 1;
  }

  private straight(points: readonly Vector[]): number {
    this.lines.push({ points, radius: null, confidence: null, bridged: null });
    return this.lines.length - 1;
  }

  async trace(request: TraceRequest): Promise<readonly number[]> {
    this.traces.push(request);
    await this.gate;
    const below = request.vessels.flat().find((point) => point[2] < FLOOR);
    if (below && !request.bridge) {
      throw new Failure('tracing', 'the way', 'no lumen', 'a vessel', 'add a point', {
        mends: [{ name: 'bridge', values: [] }],
        place: below,
        value: 35,
      });
    }
    return request.vessels.map((clicks) => this.straight(clicks));
  }

  async checkClick(click: Vector): Promise<void> {
    if (click[2] < FLOOR) {
      throw new Failure('tracing', 'point', 'fat', 'lumen', '', { place: click, value: -80 });
    }
  }

  async path({ from, to }: Parameters<Tracing['path']>[0]): Promise<readonly Vector[] | null> {
    await this.gate;
    return to[2] < FLOOR ? null : [from, [to[0], from[1], from[2]], to];
  }

  async brightest(): ReturnType<Tracing['brightest']> {
    return { point: [0, 0, 0], value: 1, vessel: null, arc_length: null };
  }

  async traceFrom(seed: Vector): ReturnType<Tracing['traceFrom']> {
    await this.gate;
    return this.branches.map((doubt, n) => ({ line: this.straight([seed, [n, 9, 9]]), doubt }));
  }

  async traceMask(): ReturnType<Tracing['traceMask']> {
    const lines = ['aorta', ''].map((name) => ({ line: this.straight([[0, 0, 0]]), name }));
    return { lines, notes: ['the mask has holes'] };
  }

  async cut(line: number, at: number): Promise<readonly [number, number]> {
    const points = this.lines[line]?.points ?? [];
    const middle: Vector = [at, 0, 0];
    return [this.straight([...points.slice(0, 1), middle]), this.straight([middle, ...points.slice(-1)])];
  }

  async join(first: number, second: number): Promise<number> {
    return this.straight([...(this.lines[first]?.points ?? []), ...(this.lines[second]?.points ?? [])]);
  }

  async line(line: number): Promise<LineContent> {
    return this.lines[line] as LineContent;
  }

  async show(lines: readonly NamedLine[]): Promise<Report> {
    this.shown.push(lines);
    await this.gate;
    return reportOf(lines);
  }

  async write(lines: readonly NamedLine[], kind: string): Promise<Uint8Array<ArrayBuffer>> {
    return new TextEncoder().encode(`${kind}: ${lines.map(({ name }) => name).join()}`);
  }
}

/** The report of a study with vessels of 10 mm. */
export function reportOf(lines: readonly NamedLine[]): Report {
  const volume = { size: [1, 1, 1], world_from_index: [], corners: [], smallest_side: 1 } as const;
  const vessels = lines.map(({ line, name }) => ({ line, name, length: 10, has_radius: true }));
  return { volume, vessels, windows: null };
}
