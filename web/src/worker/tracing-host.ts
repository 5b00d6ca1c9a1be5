/** What the page asks its worker for to trace and edit centerlines. */
import { proxyMarker, transfer } from 'comlink';
import { Failure } from '../core/failure';
import type { GivenFile, LineId, Pick, Progress, Report, Vector, View } from '../core/messages';
import { type Engine, loadJudge } from '../core/module';
import type {
  CenterlineKind,
  LineContent,
  MaskLines,
  NamedLine,
  PathRequest,
  SeedBranch,
  TraceRequest,
} from '../core/tracing';
import { ALL_OF_IT } from '../io/dicom/wanted';
import { among, BlobSource } from '../io/source';
import { Steps } from '../io/steps';
import { MaskStudy } from './mask-study';

type Told = (progress: Progress) => void;

/** What the host of the engine lends. */
export interface Lent {
  /** Runs work with the engine, one after the other; what it throws leaves as a text. */
  run<T>(work: (engine: Engine) => T | Promise<T>): Promise<T>;
  /** Says stop to all work that was asked for until then. */
  readonly signal: () => AbortSignal;
  readonly report: () => Report;
}

export class TracingHost {
  /** The page calls it where it is. */
  readonly [proxyMarker] = true;

  constructor(private readonly lent: Lent) {}

  trace(request: TraceRequest, told: Told): Promise<LineId[]> {
    return this.long('Tracing', told, (engine, heard) => engine.trace(JSON.stringify(request), heard));
  }

  checkClick(click: Vector): Promise<void> {
    return this.lent.run((engine) => engine.check_click(JSON.stringify(click)));
  }

  path(request: PathRequest): Promise<Vector[] | null> {
    return this.asked((engine) => engine.path(JSON.stringify(request)));
  }

  brightest(view: View, column: number, row: number): Promise<Pick> {
    return this.asked((engine) => engine.brightest(JSON.stringify(view), column, row));
  }

  traceFrom(seed: Vector, smallestRadius: number | null, told: Told): Promise<SeedBranch[]> {
    const work = (engine: Engine, heard: Heard) =>
      engine.trace_from(JSON.stringify(seed), smallestRadius ?? undefined, heard);
    return this.long('Finding branches', told, work);
  }

  /** Reads a mask as scans are read, and traces it. */
  traceMask(files: readonly GivenFile[], told: Told): Promise<MaskLines> {
    const signal = this.lent.signal();
    return this.lent.run(async (engine) => {
      const study = new MaskStudy(engine);
      try {
        const sources = files.map(({ path, file }) => new BlobSource(path, file));
        const { openFiles } = await import('../io/study');
        const means = { study, loadJudge, steps: new Steps(told, signal) };
        const { notes } = await openFiles(sources, among(sources), ALL_OF_IT, means);
        refuseStopped(signal);
        const made: MaskLines = JSON.parse(engine.trace_mask(hearing('Tracing the mask', told)));
        return { ...made, notes: [...notes, ...made.notes] };
      } finally {
        engine.end_mask();
      }
    });
  }

  cut(line: LineId, arcLength: number): Promise<[LineId, LineId]> {
    return this.asked((engine) => engine.cut(line, arcLength));
  }

  join(first: LineId, second: LineId): Promise<LineId> {
    return this.lent.run((engine) => engine.join(first, second));
  }

  line(line: LineId): Promise<LineContent> {
    return this.asked((engine) => engine.line(line));
  }

  add(content: LineContent): Promise<LineId> {
    return this.lent.run((engine) => engine.add_line(JSON.stringify(content)));
  }

  show(lines: readonly NamedLine[]): Promise<Report> {
    return this.lent.run((engine) => {
      engine.show(JSON.stringify(lines));
      return this.lent.report();
    });
  }

  write(lines: readonly NamedLine[], kind: CenterlineKind): Promise<Uint8Array<ArrayBuffer>> {
    return this.lent.run((engine) => {
      const bytes = engine.write_lines(JSON.stringify(lines), kind) as Uint8Array<ArrayBuffer>;
      return transfer(bytes, [bytes.buffer]);
    });
  }

  /** An answer as JSON. */
  private asked<T>(work: (engine: Engine) => string): Promise<T> {
    return this.lent.run((engine) => JSON.parse(work(engine)));
  }

  /** Work that can be stopped, and tells how far it is. */
  private long<T>(words: string, told: Told, work: (engine: Engine, heard: Heard) => string): Promise<T> {
    const signal = this.lent.signal();
    return this.asked((engine) => {
      refuseStopped(signal);
      return work(engine, hearing(words, told));
    });
  }
}

/** Hears the share that is done. */
type Heard = (share: number) => void;

function hearing(words: string, told: Told): Heard {
  return (share) => told({ words, done: Math.round(100 * share), total: 100 });
}

function refuseStopped(signal: AbortSignal): void {
  if (signal.aborted) {
    throw new Failure('interrupted', 'tracing', 'a stop', 'to run to its end');
  }
}
