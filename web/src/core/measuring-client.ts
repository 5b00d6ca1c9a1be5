/** Measuring as the page uses it: what the worker's `MeasuringHost` is asked for. */
import type { Remote } from 'comlink';
import type { MeasuringHost } from '../worker/measuring-host';
import type {
  Compared,
  Grade,
  MeasuredSection,
  MeasuredVessel,
  Measuring,
  Profile,
  ReportPlan,
  ReportRequest,
  Stretch,
} from './measuring';
import type { Pair, Progress } from './messages';

/** Hears an answer that the user waits for. */
export type First = <T>(answer: Promise<T>) => Promise<T>;

export class MeasuringClient implements Measuring {
  constructor(
    private readonly host: Remote<MeasuringHost>,
    private readonly first: First,
  ) {}

  async profile(line: number, fwhm: number | null, told: (progress: Progress) => void): Promise<Profile> {
    const words = 'measuring the vessel';
    told({ words, done: 0, total: null });
    const profile = await this.first(this.host.profile(line, fwhm));
    told({ words, done: 1, total: 1 });
    return profile;
  }

  grade(line: number, marks: MeasuredVessel['marks']): Promise<Grade> {
    return this.first(this.host.grade(line, marks));
  }

  doubts(line: number, compared: Compared): Promise<readonly string[]> {
    return this.first(this.host.doubts(line, compared));
  }

  offeredReferences(
    line: number,
    marks: MeasuredVessel['marks'],
  ): ReturnType<Measuring['offeredReferences']> {
    return this.first(this.host.offeredReferences(line, marks));
  }

  diameterAt(line: number, at: number): ReturnType<Measuring['diameterAt']> {
    return this.first(this.host.diameterAt(line, at));
  }

  section(line: number, at: number): Promise<MeasuredSection> {
    return this.first(this.host.section(line, at));
  }

  stretch(line: number, ends: Pair): Promise<Stretch> {
    return this.first(this.host.stretch(line, ends));
  }

  angleBetween(line: number, first: Pair, second: Pair): Promise<number> {
    return this.first(this.host.angleBetween(line, first, second));
  }

  csv(vessels: readonly MeasuredVessel[]): Promise<string> {
    return this.first(this.host.csv(vessels));
  }

  json(vessels: readonly MeasuredVessel[]): Promise<string> {
    return this.first(this.host.json(vessels));
  }

  reportPlan(vessel: MeasuredVessel): Promise<ReportPlan> {
    return this.first(this.host.reportPlan(vessel));
  }

  report(request: ReportRequest): Promise<string> {
    return this.first(this.host.report(request));
  }
}
