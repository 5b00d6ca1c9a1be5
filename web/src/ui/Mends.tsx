/** Buttons for those remedies of a failure that the page can perform. */
import { useEffect, useRef } from 'preact/hooks';
import type { Failure, SeriesChoice, Thumbnail } from '../core/failure';
import { type Mend, type MendName, readingWords } from '../core/mends';
import type { SeriesWish } from '../core/messages';
import { openAgain } from '../state/opened';

/** The label of a button, and the choice with which it opens the files again. */
type Button = readonly [words: string, wish: SeriesWish];

const NONE = (): readonly Button[] => [];
const spaces = ({ values }: Mend): readonly Button[] =>
  values.map((space) => [`Read as ${space.toUpperCase()}`, { coordinates: space }]);

/** Buttons of each remedy. Series are chosen from a list, and `Messages.tsx` has the button for gaps. */
const BUTTONS: Record<MendName, (mend: Mend) => readonly Button[]> = {
  bridge: NONE,
  every_second: () => [['Load every second voxel along each axis', { every_second: true }]],
  cpu: NONE,
  windows: NONE,
  threshold: NONE,
  fewer_pixels: NONE,
  doubtful: NONE,
  smaller_radius: NONE,
  other_patient: NONE,
  coordinates: spaces,
  unit: ({ values }) => values.map((unit) => [`Read in ${unit}`, { unit }]),
  place: spaces,
  reading: ({ values }) =>
    values.map((value) => {
      const [coordinates = '', unit = ''] = value.split(' in ');
      return [`Read as ${readingWords(value)}`, { coordinates, unit }];
    }),
  reorder: () => [['Put the points in order', { reorder: true }]],
  series: NONE,
  phase: ({ values }) => values.map((phase) => [`Read the phase ${phase}`, { phase }]),
  fill_gaps: () => [['Interpolate the missing slices', { fill_gaps: true }]],
  resample_slices: () => [['Put the slices on a regular grid', { resample_slices: true }]],
  resample_and_fill: () => [
    [
      'Put the slices on a regular grid, and interpolate the missing ones',
      { resample_slices: true, fill_gaps: true },
    ],
  ],
};

export function Mends({ failure }: { readonly failure: Failure }) {
  return (
    <>
      {failure.isMendedBy('series') && <Series of={failure.series} />}
      {failure.mends
        .flatMap((mend) => BUTTONS[mend.name](mend))
        .map(([words, wish]) => (
          <button key={words} type="button" onClick={() => void openAgain(wish)}>
            {words}
          </button>
        ))}
    </>
  );
}

function Series({ of }: { readonly of: readonly SeriesChoice[] }) {
  return (
    <ul class="series" aria-label="Series">
      {of.map((one) => (
        <li key={one.uid}>
          <button type="button" onClick={() => void openAgain({ series: one.uid })}>
            {one.thumbnail && <SeriesThumbnail of={one.thumbnail} />}
            {wordsOf(one)}
          </button>
        </li>
      ))}
    </ul>
  );
}

function wordsOf({ number, description, modality, images, size, spacing, trouble }: SeriesChoice): string {
  const steps = spacing?.map((step) => Number(step.toPrecision(3)));
  const extent = size && steps ? [size.join(' × '), `${steps.join(' × ')} mm`] : [`${images} images`];
  const parts = [description || 'no description', modality, ...extent, trouble];
  return `${number || '–'}: ${parts.filter((part) => part !== '').join(' · ')}`;
}

function SeriesThumbnail({ of }: { readonly of: Thumbnail }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { width, height, grey } = of;
  useEffect(() => {
    const rgba = Uint8ClampedArray.from(grey.flatMap((value) => [value, value, value, 255]));
    canvas.current?.getContext('2d')?.putImageData(new ImageData(rgba, width, height), 0, 0);
  }, [of]);
  return <canvas ref={canvas} width={width} height={height} data-testid="series-thumbnail" aria-hidden />;
}
