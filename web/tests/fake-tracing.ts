/** A fake engine that traces straight lines between clicks, and records all requests. */

import { Failure } from '../src/core/failure';
import type {
  AfterEdit,
  Answer,
  Asked,
  DocumentVessel,
  Edit,
  Edited,
  EditRequest,
  FirstClick,
  LineContent,
  ListedLine,
  Message,
  NamedLine,
  Question,
  Report,
  Vector,
  VesselDocument,
} from '../src/core/messages';

/** Below this z (mm), the fake engine finds no lumen. */
export const FLOOR = -50;

export class FakeTracing implements Asked {
  readonly lines: LineContent[] = [];
  readonly edits: EditRequest[] = [];
  readonly shown: (readonly ListedLine[])[] = [];
  notes: readonly string[] = [];
  /** Edits and trees are delayed until this promise resolves. */
  gate: Promise<void> = Promise.resolve();
  windows: Report['windows'] = null;
  private lastId = 100;

  readonly trips: Question[] = [];

  ask<N extends Question>(name: N, message: Message<N>): Promise<Answer<N>> {
    this.trips.push(name);
    return (this as unknown as Answering)[name](message) as Promise<Answer<N>>;
  }

  async add_line(content: LineContent): Promise<number> {
    this.lines.push(content);
    return this.lines.length - 1;
  }

  private straight(points: readonly Vector[]): number {
    this.lines.push({ points, radius: null, confidence: null, bridged: null, by_hand: null });
    return this.lines.length - 1;
  }

  async across({ at }: Message<'across'>): Promise<Answer<'across'>> {
    return [
      [0, 0, at],
      [1, 0, 0],
      [0, 1, 0],
    ];
  }

  async at(point: Vector): Promise<Answer<'at'>> {
    return { point, value: 7, vessel: null, arc_length: null };
  }

  async begin_document(): Promise<VesselDocument> {
    return NOTHING;
  }

  /** Performs the edits that tests need: clicks, straight lines, and bridges below `FLOOR`. */
  async edit(request: EditRequest): Promise<AfterEdit> {
    const edited = await this.made(request);
    const { vessels } = edited.document;
    const known = request.document.vessels.map(({ line }) => line);
    const sure = vessels.filter(({ doubt }) => doubt === null);
    const listed = sure.map(({ line, name, isHidden }) => ({ line, name, hidden: isHidden }));
    return {
      edited,
      report: reportOf(listed.filter(({ hidden }) => !hidden)),
      lines: vessels
        .filter(({ line }) => !known.includes(line))
        .map(({ line }) => ({ line, content: this.lines[line] as LineContent })),
      facts: sure.map(({ line }) => ({
        line,
        length: 10,
        calibre: null,
        part: 0,
        parent: null,
        suggested_name: null,
        is_vein_or_heart: false,
      })),
      pick: null,
    };
  }

  private async made(request: EditRequest): Promise<Edited> {
    this.edits.push(request);
    await this.gate;
    const { document, edit, bridging } = request;
    const changed = this.changed(document, edit);
    const after = { ...document, ...changed, bridge: changed.bridge ?? (document.bridge || bridging) };
    const below = after.vessels.flatMap((vessel) => vessel.clicks ?? []).find((point) => point[2] < FLOOR);
    if (below && !after.bridge) {
      throw new Failure('tracing', 'the way', 'no lumen', 'a vessel', 'add a point', {
        mends: [{ name: 'bridge', values: [] }],
        place: below,
        value: 35,
      });
    }
    const before = document.vessels.map((vessel) => vessel.id);
    const ids = after.vessels.map((vessel) => vessel.id);
    return {
      document: structuredClone(after),
      words: bridging ? `${edit.kind} and bridge` : edit.kind,
      added: ids.filter((id) => !before.includes(id)),
      without_marks: before.filter((id) => !ids.includes(id)),
      notes: this.notes,
      doubts: [],
      told: null,
    };
  }

  private changed({ vessels, stoppers }: VesselDocument, edit: Edit): Partial<VesselDocument> {
    const clicked = (id: number, how: (clicks: readonly Vector[]) => readonly Vector[]) => ({
      vessels: vessels.map((vessel) =>
        vessel.id === id ? this.traced(vessel, how(vessel.clicks ?? [])) : vessel,
      ),
    });
    switch (edit.kind) {
      case 'begin_vessel':
        this.lastId += 1;
        return { vessels: [...vessels, this.traced(vesselOf(this.lastId), edit.clicks)] };
      case 'add_click':
        return clicked(edit.id, (clicks) => [...clicks, edit.point]);
      case 'remove_click':
        return clicked(edit.id, (clicks) => clicks.toSpliced(edit.number, 1)).vessels.some(
          (vessel) => vessel.clicks?.length === 1,
        )
          ? { vessels: vessels.filter((vessel) => vessel.id !== edit.id) }
          : clicked(edit.id, (clicks) => clicks.toSpliced(edit.number, 1));
      case 'add_stopper':
        return { stoppers: [...stoppers, { center: edit.center, radius: 3 }] };
      case 'set_bridge':
        return { bridge: edit.bridge };
      case 'remove':
        return { vessels: vessels.filter((vessel) => !edit.ids.includes(vessel.id)) };
      default:
        return {};
    }
  }

  private traced(vessel: DocumentVessel, clicks: readonly Vector[]): DocumentVessel {
    return { ...vessel, clicks, line: this.straight(clicks) };
  }

  async first_click({ click }: Message<'first_click'>): Promise<FirstClick> {
    if (click[2] < FLOOR) {
      throw new Failure('tracing', 'point', 'fat', 'lumen', '', { place: click, value: -80 });
    }
    return { pick: { point: click, value: 300, vessel: null, arc_length: null }, whole: null };
  }

  async path({ from, to }: Message<'path'>): Promise<Answer<'path'>> {
    await this.gate;
    return to[2] < FLOOR ? null : [from, [to[0], from[1], from[2]], to];
  }

  async whole_vessel(): Promise<Answer<'whole_vessel'>> {
    return null;
  }

  async line({ line }: Message<'line'>): Promise<LineContent> {
    return this.lines[line] as LineContent;
  }

  async show({ lines }: Message<'show'>): Promise<Report> {
    this.shown.push(lines);
    await this.gate;
    return { ...reportOf(lines.filter(({ hidden }) => !hidden)), windows: this.windows };
  }

  async write_lines({ lines, kind }: Message<'write_lines'>): Promise<Answer<'write_lines'>> {
    const text = `${kind}: ${lines.map(({ name }) => name).join()}`;
    return { bytes: new Uint8ClampedArray(new TextEncoder().encode(text)) };
  }
}

type Answering = Readonly<Record<Question, (message: unknown) => Promise<unknown>>>;

export function reportOf(lines: readonly NamedLine[]): Report {
  const volume = {
    size: [1, 1, 1],
    world_from_index: [],
    corners: [],
    smallest_side: 1,
    pixel_side: 0.25,
    scan: '',
    doubt: null,
    notes: [],
    contours: [],
  } as const;
  const vessels = lines.map(({ line, name }) => ({ line, name, length: 10, has_radius: true }));
  return { volume, vessels, windows: null };
}

const NOTHING: VesselDocument = { vessels: [], stoppers: [], bridge: false, bone_hidden: false, dark: false };

function vesselOf(id: number): DocumentVessel {
  const color = '#ffffff';
  return { id, line: id, name: `n${id}`, color, isHidden: false, clicks: null, doubt: null, contours: [] };
}

/** A document of vessels with these line numbers; the ids count from 1. */
export function documentOf(...lines: readonly number[]): VesselDocument {
  return { ...NOTHING, vessels: lines.map((line, n) => ({ ...vesselOf(n + 1), line, name: `n${line}` })) };
}

export function withLines<T extends VesselDocument>(document: T, ...lines: readonly number[]): T {
  const first = Math.max(0, ...document.vessels.map((vessel) => vessel.id)) + 1;
  const added = lines.map((line, n) => ({ ...vesselOf(first + n), line, name: '' }));
  return { ...document, vessels: [...document.vessels, ...added] };
}
