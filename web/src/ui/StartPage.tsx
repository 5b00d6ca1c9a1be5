/** What the page shows while nothing is open: what to do, and a phantom to try it with. */
import { engine } from '../core/shared';
import { started } from '../state/store';
import { openPhantom } from '../state/study';
import { OpenButtons } from './OpenButtons';

const PHANTOMS: readonly (readonly [string, string])[] = [
  ['aorta', 'Aorta and its branches'],
  ['cervical', 'Arteries of the neck'],
  ['stenosis', 'A tube with a narrowing of 50 %'],
];

export function StartPage() {
  const isReady = started.value !== null;
  return (
    <main class="start">
      <h1>Lumencut</h1>
      <p>See the inside of all vessels of a CT or MR angiography in one view that turns freely.</p>
      <p>The scan stays in this browser: nothing leaves your machine.</p>
      <section class="open-here" aria-label="Open a scan">
        <p>Drop a scan here: a DICOM folder or zip archive, NIfTI, NRRD or MetaImage, and its centerlines.</p>
        <OpenButtons />
      </section>
      <h2>Try it with a phantom</h2>
      <ul class="phantoms">
        {PHANTOMS.map(([name, words]) => (
          <li key={name}>
            <button type="button" disabled={!isReady} onClick={() => void openPhantom(engine, name)}>
              {words}
            </button>
          </li>
        ))}
      </ul>
      <p class="notice">
        Lumencut is not a medical device. Do not use it for diagnosis.{' '}
        <a href="./THIRD-PARTY-NOTICES.txt">Licences of third parties</a>
      </p>
    </main>
  );
}
