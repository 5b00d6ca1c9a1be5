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
}

/** What only some errors tell beside their words. */
interface More {
  /** The DICOM series of which none was chosen. */
  readonly series?: readonly SeriesChoice[];
  /** Where it shows in the volume (mm, LPS), and what the volume has there. */
  readonly place?: Vector;
  readonly value?: number;
}

/** Errors in the words of the whole of Lumencut: what is wrong, what was found, what was expected, what mends it. */
export class Failure extends Error {
  readonly series: readonly SeriesChoice[];
  readonly place: Vector | null;
  readonly value: number | null;

  constructor(
    readonly kind: string,
    readonly subject: string,
    readonly found: string,
    readonly expected: string,
    readonly mend = '',
    { series = [], place, value }: More = {},
  ) {
    const words = [`${subject}: found ${found}`, `expected ${expected}`, mend];
    super(words.filter((part) => part !== '').join('; '));
    this.name = 'Failure';
    this.series = series;
    this.place = place ?? null;
    this.value = value ?? null;
  }

  /** What was thrown as a failure: the JSON that the core throws, or any other error in its own words. */
  static of(thrown: unknown): Failure {
    if (thrown instanceof Failure) {
      return thrown;
    }
    const text = thrown instanceof Error ? thrown.message : String(thrown);
    const fields = parsed(text);
    if (fields) {
      const { kind, subject, found, expected, mend } = fields;
      return new Failure(kind, subject, found, expected, mend, fields);
    }
    return new Failure(
      'unexpected',
      'the page',
      text,
      'no error here',
      'reload the page and open the scan again',
    );
  }

  /** As a text that survives the way between worker and page; `of` reads it again. */
  get text(): string {
    const { kind, subject, found, expected, mend, series, place, value } = this;
    const more: More = { series, ...(place && { place }), ...(value !== null && { value }) };
    return JSON.stringify({ kind, subject, found, expected, mend, ...more });
  }
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
