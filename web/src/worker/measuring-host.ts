/** What the page asks its worker for to measure vessels. All numbers are the engine's. */
import { proxyMarker } from 'comlink';
import type {
  Compared,
  Grade,
  Marks,
  MeasuredSection,
  MeasuredVessel,
  Profile,
  ReportPlan,
  ReportRequest,
  Spot,
  Stretch,
} from '../core/measuring';
import type { LineId, Pair } from '../core/messages';
import type { Engine } from '../core/module';

/** Runs work on the engine, after all that was asked for before. */
export type Run = <T>(work: (engine: Engine) => T) => Promise<T>;

export class MeasuringHost {
  /** The page calls it where it is, in the worker. */
  readonly [proxyMarker] = true;

  constructor(private readonly run: Run) {}

  profile(line: LineId, fwhm: number | null): Promise<Profile> {
    return this.run((engine) => JSON.parse(engine.profile(line, fwhm ?? undefined)));
  }

  grade(line: LineId, marks: Marks): Promise<Grade> {
    return this.run((engine) => JSON.parse(engine.grade(line, JSON.stringify(marks))));
  }

  doubts(line: LineId, compared: Compared): Promise<readonly string[]> {
    return this.run((engine) => JSON.parse(engine.doubts(line, JSON.stringify(compared))));
  }

  offeredReferences(line: LineId, marks: Marks): Promise<readonly [Spot | null, Spot | null]> {
    return this.run((engine) => JSON.parse(engine.offered_references(line, JSON.stringify(marks))));
  }

  diameterAt(line: LineId, at: number): Promise<{ diameter: number; uncertainty: number | null }> {
    return this.run((engine) => JSON.parse(engine.diameter_at(line, at)));
  }

  section(line: LineId, at: number): Promise<MeasuredSection> {
    return this.run((engine) => JSON.parse(engine.measured_section(line, at)));
  }

  stretch(line: LineId, [start, end]: Pair): Promise<Stretch> {
    return this.run((engine) => JSON.parse(engine.stretch(line, start, end)));
  }

  angleBetween(line: LineId, first: Pair, second: Pair): Promise<number> {
    return this.run((engine) => engine.angle_between(line, JSON.stringify([first, second])));
  }

  csv(vessels: readonly MeasuredVessel[]): Promise<string> {
    return this.run((engine) => engine.profiles_csv(JSON.stringify(vessels)));
  }

  json(vessels: readonly MeasuredVessel[]): Promise<string> {
    return this.run((engine) => engine.profiles_json(JSON.stringify(vessels)));
  }

  reportPlan(vessel: MeasuredVessel): Promise<ReportPlan> {
    return this.run((engine) => JSON.parse(engine.report_plan(JSON.stringify(vessel))));
  }

  report(request: ReportRequest): Promise<string> {
    return this.run((engine) => engine.measured_report(JSON.stringify(request)));
  }
}
