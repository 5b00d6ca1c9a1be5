/** What the page asks its worker for to trace and edit centerlines. */
import { proxyMarker, transfer } from 'comlink';
import type { Edited, EditRequest, VesselDocument } from '../core/edits';
import { Failure } from '../core/failure';
import type { GivenFile, LineId, Pick, Progress, Report, Vector, View } from '../core/messages';
import { type Engine, loadJudge } from '../core/module';
import type { CenterlineKind, LineContent, NamedLine, PathRequest } from '../core/tracing';
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

  beginDocument(): Promise<VesselDocument> {
    return this.asked((engine) => engine.begin_document());
  }

  edit(request: EditRequest, told: Told, mask: readonly GivenFile[] | null): Promise<Edited> {
    const signal = this.lent.signal();
    return this.lent.run(async (engine) => {
      refuseStopped(signal);
      return mask ? withMask(engine, request, told, { files: mask, signal }) : edited(engine, request, told);
    });
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
}

/** What edits are called that take a while; all others trace. */
const WORDS: Partial<Record<EditRequest['edit']['kind'], string>> = {
  add_branches: 'Finding branches',
  add_mask: 'Tracing the mask',
};

function edited(engine: Engine, request: EditRequest, told: Told): Edited {
  const words = WORDS[request.edit.kind] ?? 'Tracing';
  const heard = (share: number) => told({ words, done: Math.round(100 * share), total: 100 });
  return JSON.parse(engine.edit(JSON.stringify(request), heard));
}

/** The files of a mask, and what says stop while they are read. */
interface Mask {
  readonly files: readonly GivenFile[];
  readonly signal: AbortSignal;
}

/** Reads a mask as scans are read, and has it traced. */
async function withMask(
  engine: Engine,
  request: EditRequest,
  told: Told,
  { files, signal }: Mask,
): Promise<Edited> {
  const study = new MaskStudy(engine);
  try {
    const sources = files.map(({ path, file }) => new BlobSource(path, file));
    const { openFiles } = await import('../io/study');
    const means = { study, loadJudge, steps: new Steps(told, signal) };
    const { notes } = await openFiles(sources, among(sources), ALL_OF_IT, means);
    refuseStopped(signal);
    const made = edited(engine, request, told);
    return { ...made, notes: [...notes, ...made.notes] };
  } finally {
    engine.end_mask();
  }
}

function refuseStopped(signal: AbortSignal): void {
  if (signal.aborted) {
    throw new Failure('interrupted', 'tracing', 'a stop', 'to run to its end');
  }
}
