/** Tracing and editing as the page uses them: calls to the worker. */
import { proxy, type Remote } from 'comlink';
import type { TracingHost } from '../worker/tracing-host';
import type { Edited, EditRequest, VesselDocument } from './edits';
import type { GivenFile, LineId, Pick, Progress, Report, Vector, View } from './messages';
import type { CenterlineKind, LineContent, NamedLine, PathRequest, Tracing } from './tracing';

type Told = (progress: Progress) => void;

export class TracingClient implements Tracing {
  constructor(
    private readonly host: Remote<TracingHost>,
    /** Hears an answer that the user waits for. */
    private readonly first: <T>(answer: Promise<T>) => Promise<T>,
  ) {}

  beginDocument(): Promise<VesselDocument> {
    return this.first(this.host.beginDocument());
  }

  edit(request: EditRequest, told: Told, mask: readonly GivenFile[] | null): Promise<Edited> {
    return this.first(this.host.edit(request, proxy(told), mask));
  }

  checkClick(click: Vector): Promise<void> {
    return this.first(this.host.checkClick(click));
  }

  path(request: PathRequest): Promise<readonly Vector[] | null> {
    return this.first(this.host.path(request));
  }

  brightest(view: View, [column, row]: readonly [number, number]): Promise<Pick> {
    return this.first(this.host.brightest(view, column, row));
  }

  line(line: LineId): Promise<LineContent> {
    return this.first(this.host.line(line));
  }

  add(content: LineContent): Promise<LineId> {
    return this.first(this.host.add(content));
  }

  show(lines: readonly NamedLine[]): Promise<Report> {
    return this.first(this.host.show(lines));
  }

  write(lines: readonly NamedLine[], kind: CenterlineKind): Promise<Uint8Array<ArrayBuffer>> {
    return this.first(this.host.write(lines, kind));
  }
}
