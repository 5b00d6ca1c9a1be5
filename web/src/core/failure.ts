/** Errors as the page has them: typed, with what was found, what was expected and what mends it. */
import { type Mend, type MendName, mendWords } from './mends';
import type { Vector } from './messages';

/** A DICOM series that can be chosen. */
export interface SeriesChoice {
  readonly number: string;
  readonly uid: string;
  readonly description: string;
  readonly modality: string;
  readonly images: number;
  /** Voxels along i, j, k, and their sizes (mm); null where the images form no stack. */
  readonly size: readonly number[] | null;
  readonly spacing: readonly number[] | null;
  /** Why the images form no angiography volume, empty where they may. */
  readonly trouble: string;
  /** Its middle slice, where that could be read. */
  readonly thumbnail?: Thumbnail;
}

/** A small grey picture: a byte for each pixel, in rows from the top. */
export interface Thumbnail {
  readonly width: number;
  readonly height: number;
  readonly grey: readonly number[];
}

/** Clicked points, counted from 0. */
export interface About {
  /** The vessel; null for a point of no vessel yet. */
  readonly vessel: number | null;
  /** The point along it; null where all of them are meant. */
  readonly point: number | null;
}

/** What only some errors tell beside their words. */
export interface More {
  /** What mends it beside the advice. */
  readonly mends?: readonly Mend[];
  /** The clicked points that it is about. */
  readonly about?: About;
  /** The DICOM series of which none was chosen. */
  readonly series?: readonly SeriesChoice[];
  /** Where it shows in the volume (mm, LPS), and what the volume has there. */
  readonly place?: Vector;
  readonly value?: number;
}

/** The kind of what the module throws where it ends in the middle of its work; nothing more can be asked of it. */
export const CRASH = 'crash';

/** An error: what is wrong, what was found, what was expected, advice, and what mends it, by names that the page words. */
export class Failure extends Error {
  readonly mends: readonly Mend[];
  readonly series: readonly SeriesChoice[];
  readonly about: About | null;
  readonly place: Vector | null;
  readonly value: number | null;

  constructor(
    readonly kind: string,
    readonly subject: string,
    readonly found: string,
    readonly expected: string,
    /** Advice that the page does not act on. */
    readonly advice = '',
    { mends = [], series = [], about, place, value }: More = {},
  ) {
    const words = [`${subject}: found ${found}`, `expected ${expected}`, mending(advice, mends)];
    super(words.filter((part) => part !== '').join('; '));
    this.name = 'Failure';
    this.mends = mends;
    this.series = series;
    this.about = about ?? null;
    this.place = place ?? null;
    this.value = value ?? null;
  }

  /** What was thrown as a failure: the JSON that the core throws, a stop, the end of the module, or any other error in its own words. */
  static of(thrown: unknown): Failure {
    if (thrown instanceof Failure) {
      return thrown;
    }
    if (thrown instanceof DOMException && thrown.name === 'AbortError') {
      return new Failure('interrupted', 'the page', 'a stop', 'a complete run');
    }
    const text = thrown instanceof Error ? thrown.message : String(thrown);
    const fields = parsed(text);
    if (fields) {
      const { kind, subject, found, expected, mend } = fields;
      return new Failure(kind, subject, found, expected, mend, fields);
    }
    if (thrown instanceof Error && thrown.name === 'RuntimeError') {
      const advice = 'save the session, reload the page, and open the scan and the session again';
      return new Failure(CRASH, 'the engine of the page', `a crash: ${text}`, 'an answer', advice);
    }
    return new Failure('unexpected', 'the page', text, 'no error', 'reload the page and open the scan again');
  }

  /** What mends it in the words of the page, advice first; empty where nothing is known. */
  get mending(): string {
    return mending(this.advice, this.mends);
  }

  /** Whether this mends it. */
  isMendedBy(name: MendName): boolean {
    return this.mends.some((mend) => mend.name === name);
  }

  /** What it tells beside its words. */
  get more(): More {
    const { mends, series, about, place, value } = this;
    return {
      mends,
      series,
      ...(about && { about }),
      ...(place && { place }),
      ...(value !== null && { value }),
    };
  }

  /** As a text that survives the way between worker and page; `of` reads it again. */
  get text(): string {
    const { kind, subject, found, expected, advice: mend, more } = this;
    return JSON.stringify({ kind, subject, found, expected, mend, ...more });
  }
}

function mending(advice: string, mends: readonly Mend[]): string {
  return [advice, ...mends.map(mendWords)].filter((words) => words !== '').join(', or ');
}

interface Fields extends More {
  kind: string;
  subject: string;
  found: string;
  expected: string;
  mend: string;
}

function parsed(text: string): Fields | null {
  try {
    const fields: unknown = JSON.parse(text);
    const names = ['kind', 'subject', 'found', 'expected', 'mend'] as const;
    if (fields === null || typeof fields !== 'object') {
      return null;
    }
    return names.every((name) => typeof (fields as Fields)[name] === 'string') ? (fields as Fields) : null;
  } catch {
    return null;
  }
}
