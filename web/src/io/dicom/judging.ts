/** Asks `lumencut-dicom` for the plan of a volume, or the reason why there is none. */
import { Failure, type SeriesChoice } from '../../core/failure';
import type { Mend } from '../../core/mends';
import type { Judge } from '../../core/module';
import type { ExaminedFile } from './headers';
import { TRANSFER_SYNTAXES } from './pixels';
import type { Asked } from './records';
import type { Wanted } from './wanted';

export interface Plan {
  readonly size: readonly [number, number, number];
  readonly world_from_index: readonly (readonly number[])[];
  readonly slices: readonly PlannedSlice[];
  readonly fills: readonly Fill[];
  /** Pairs of slices that are copies of each other if their values are equal. */
  readonly compared: readonly Compared[];
  readonly notes: readonly string[];
  /** Acquisition parameters, in the form that the engine expects. */
  readonly scan: object;
  readonly patient: { readonly id: string; readonly issuer: string };
  readonly details: { readonly modality: string };
}

export interface PlannedSlice {
  readonly file: number;
  readonly frame: number;
  readonly place: number;
  readonly slope: number;
  readonly intercept: number;
}

/** A slice that is kept, and another that may be its copy. */
export interface Compared {
  readonly kept: PlannedSlice;
  readonly other: PlannedSlice;
}

/** Slice `k` is interpolated: (1 - part) × slice `before` + part × slice `after`. */
export interface Fill {
  readonly k: number;
  readonly before: number;
  readonly after: number;
  readonly part: number;
}

interface Trouble {
  readonly kind: 'format' | 'series';
  readonly file: number | null;
  readonly found: string;
  readonly expected: string;
  readonly advice: string;
  readonly mends: readonly Mend[];
  readonly series: readonly SeriesChoice[];
}

export function asked(judge: Judge): Asked {
  return JSON.parse(judge.dicom_attributes());
}

export interface Question {
  readonly subject: string;
  readonly files: readonly ExaminedFile[];
  readonly wanted: Wanted;
  readonly unlike?: readonly Compared[];
}

export function judged(judge: Judge, { subject, files, wanted, unlike = [] }: Question): Plan {
  const records = files.map((file) => file.record);
  const headers = { transfer_syntaxes: TRANSFER_SYNTAXES, files: records, unlike };
  const answer = JSON.parse(judge.judge_dicom(JSON.stringify(headers), JSON.stringify(wanted)));
  if (answer.plan) {
    return answer.plan;
  }
  const trouble: Trouble = answer.error;
  const named = trouble.file === null ? subject : (files[trouble.file]?.source.path ?? subject);
  const { found, expected, advice, mends, series } = trouble;
  throw new Failure('format', named, found, expected, advice, { mends, series });
}
