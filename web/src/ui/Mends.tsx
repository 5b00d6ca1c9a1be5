/** What can be done at once about files that were refused. */
import type { Failure, SeriesChoice } from '../core/failure';
import type { SeriesWish } from '../core/messages';
import { openAgain } from '../state/last-opened';

const WISHES: readonly (readonly [keyof SeriesWish, string])[] = [
  ['fill_gaps', 'Interpolate the missing slices'],
  ['resample_slices', 'Put the slices on a regular grid'],
  ['every_second', 'Take every second voxel along each axis'],
];

export function Mends({ failure }: { readonly failure: Failure }) {
  const wishes = WISHES.filter(([name]) => failure.mend.includes(`${name}=True`));
  return (
    <>
      {failure.series.length > 0 && (
        <ul class="series" aria-label="Series">
          {failure.series.map((one) => (
            <li key={one.uid}>
              <button type="button" onClick={() => void openAgain({ series: one.uid })}>
                {wordsOf(one)}
              </button>
            </li>
          ))}
        </ul>
      )}
      {failure.mend.includes('coordinates=') && <SpaceChoice />}
      {wishes.map(([name, words]) => (
        <button key={name} type="button" onClick={() => void openAgain({ [name]: true })}>
          {words}
        </button>
      ))}
    </>
  );
}

/** The two spaces that the coordinates of centerlines can be meant in. */
function SpaceChoice() {
  return (
    <>
      <button type="button" onClick={() => void openAgain({ coordinates: 'lps' })}>
        Read as LPS
      </button>
      <button type="button" onClick={() => void openAgain({ coordinates: 'ras' })}>
        Read as RAS
      </button>
    </>
  );
}

/** A series on one line. */
function wordsOf({ number, description, modality, images, size, spacing, trouble }: SeriesChoice): string {
  const steps = spacing?.map((step) => Number(step.toPrecision(3)));
  const extent = size && steps ? [size.join(' × '), `${steps.join(' × ')} mm`] : [`${images} images`];
  const parts = [description || 'no description', modality, ...extent, trouble];
  return `${number || '–'}: ${parts.filter((part) => part !== '').join(' · ')}`;
}
