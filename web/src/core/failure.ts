/** The errors of the page state what was found, what was expected, and a remedy. */
import { type Mend, type MendName, mendWords } from './mends';
import type { Vector } from './messages';

export interface SeriesChoice {
  readonly number: string;
  readonly uid: string;
  readonly description: string;
  readonly modality: string;
  readonly images: number;
  /** Numbers of voxels along i, j and k, and voxel sizes (mm); null if the images form no stack. */
  readonly size: readonly number[] | null;
  readonly spacing: readonly number[] | null;
  /** Why the images cannot be an angiography volume; empty if they can. */
  readonly trouble: string;
  readonly thumbnail?: Thumbnail;
}

/** A small grey picture: one byte per pixel, in rows from the top. */
export interface Thumbnail {
  readonly width: number;
  readonly height: number;
  readonly grey: readonly number[];
}

/** The clicked point that an error concerns; vessels and points count from 0. */
export interface About {
  /** Null for a point that belongs to no vessel yet. */
  readonly vessel: number | null;
  /** Null if the error concerns all points of the vessel. */
  readonly point: number | null;
}

export interface More {
  readonly mends?: readonly Mend[];
  readonly about?: About;
  readonly series?: readonly SeriesChoice[];
  /** Position in the volume that the error concerns (mm, LPS), and the value there. */
  readonly place?: Vector;
  readonly value?: number;
  /** The nearest place that suits (mm, LPS). */
  readonly nearest?: Vector;
}

/** The `kind` of a failure after a crash of the WebAssembly module, which then answers no more requests. */
export const CRASH = 'crash';

/** The failure after a crash. `memory` is what the engine had (bytes), if it could not have got much more. */
export function crashed(text: string, memory: number | null = null): Failure {
  const isShort = memory !== null;
  const found = isShort
    ? `a crash, probably because memory is short: ${Math.round(memory / 2 ** 20)} MiB are in use`
    : `a crash: ${text}`;
  const close = isShort ? 'close other pages, ' : '';
  const advice = `save the session, ${close}reload the page, and open the scan and the session again`;
  return new Failure(CRASH, 'the engine of the page', found, 'an answer', advice);
}

/** An error with advice as text, and with named remedies that the page puts into words. */
export class Failure extends Error {
  readonly mends: readonly Mend[];
  readonly series: readonly SeriesChoice[];
  readonly about: About | null;
  readonly place: Vector | null;
  readonly value: number | null;
  readonly nearest: Vector | null;

  constructor(
    readonly kind: string,
    readonly subject: string,
    readonly found: string,
    readonly expected: string,
    /** Advice for the user, which has no button. */
    readonly advice = '',
    { mends = [], series = [], about, place, value, nearest }: More = {},
  ) {
    const words = [`${subject}: found ${found}`, `expected ${expected}`, mending(advice, mends)];
    super(words.filter((part) => part !== '').join('; '));
    this.name = 'Failure';
    this.mends = mends;
    this.series = series;
    this.about = about ?? null;
    this.place = place ?? null;
    this.value = value ?? null;
    this.nearest = nearest ?? null;
  }

  /** Converts anything thrown: an error of the Rust code (JSON), an abort, a crash of the module, or another error. */
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
      return crashed(text);
    }
    return new Failure('unexpected', 'the page', text, 'no error', 'reload the page and open the scan again');
  }

  /** Advice and remedies as one text; empty if there are none. */
  get mending(): string {
    return mending(this.advice, this.mends);
  }

  isMendedBy(name: MendName): boolean {
    return this.mends.some((mend) => mend.name === name);
  }

  get more(): More {
    const { mends, series, about, place, value, nearest } = this;
    return {
      mends,
      series,
      ...(about && { about }),
      ...(place && { place }),
      ...(value !== null && { value }),
      ...(nearest && { nearest }),
    };
  }

  /** The failure as JSON, for messages between worker and page; `of` parses it. */
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
