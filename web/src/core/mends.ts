/** Remedies of failures: their names, which page and Python package share, and their texts in the page. */

/** All names, in the order in which the Rust crates define them. */
export const MEND_NAMES = [
  'bridge',
  'every_second',
  'cpu',
  'windows',
  'threshold',
  'fewer_pixels',
  'doubtful',
  'smaller_radius',
  'other_patient',
  'coordinates',
  'unit',
  'place',
  'reading',
  'reorder',
  'series',
  'phase',
  'fill_gaps',
  'resample_slices',
  'resample_and_fill',
] as const;

export type MendName = (typeof MEND_NAMES)[number];

export interface Mend {
  readonly name: MendName;
  readonly values: readonly string[];
}

export const EVERY_SECOND: Mend = { name: 'every_second', values: [] };

/** Converts the axes to capitals: `LPS in cm` for `lps in cm`. */
export const readingWords = (reading: string): string =>
  reading.replace(/^\w+/, (space) => space.toUpperCase());

const spaces = ({ values }: Mend): string => values.map((space) => space.toUpperCase()).join(' or ');

const WORDS: Record<MendName, (mend: Mend) => string> = {
  bridge: () => 'bridge the gap where the vessel is occluded',
  every_second: () => 'load every second voxel along each axis, an eighth of the data',
  cpu: () => 'compute on the CPU: add ?device=cpu to the address of this page',
  windows: () => 'use the Python package, which accepts windows for such values',
  threshold: () => 'convert it to an integer mask, or trace it with `lumencut trace --threshold`',
  fewer_pixels: () => 'make the view smaller',
  doubtful: () => 'review the doubtful vessels',
  smaller_radius: () => 'search for thinner vessels with `lumencut trace --smallest-radius`',
  other_patient: () => 'compare them anyway',
  coordinates: (mend) => `choose its coordinate system, ${spaces(mend)}`,
  unit: ({ values }) => `choose the unit of its coordinates, ${values.join(' or ')}`,
  place: (mend) => `choose its coordinate system, ${spaces(mend)}, if it belongs to this scan`,
  reading: ({ values }) => `choose its coordinate system and unit, ${values.map(readingWords).join(' or ')}`,
  reorder: () => 'put the points of the file in order',
  series: () => 'choose one of the series',
  phase: ({ values }) =>
    values.length > 0 ? 'choose one of the phases' : 'read one phase with the Python package',
  fill_gaps: () => 'interpolate the missing slices',
  resample_slices: () => 'put the slices on a regular grid',
  resample_and_fill: () => 'put the slices on a regular grid, and interpolate the missing ones',
};

export const mendWords = (mend: Mend): string => WORDS[mend.name](mend);
