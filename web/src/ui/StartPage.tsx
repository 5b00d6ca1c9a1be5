import { started } from '../state/store';
import { isCompanion } from '../state/two-scans';
import { openPhantom } from '../study/study';
import { startGuide } from './Guide';
import { OpenButtons } from './OpenButtons';

const PHANTOMS: readonly (readonly [string, string])[] = [
  ['aorta', 'Aorta and its branches'],
  ['cervical', 'Arteries of the neck'],
  ['stenosis', 'A tube with a stenosis of 50 %'],
];

export function StartPage() {
  return isCompanion.value ? <OpenOther /> : <Start />;
}

function OpenOther() {
  return (
    <main class="start">
      <h1>Other scan</h1>
      <p>Open another scan of the patient, such as an earlier one. You can drop its centerlines with it.</p>
      <section class="open-here" aria-label="Open the other scan">
        <OpenButtons />
      </section>
    </main>
  );
}

function Start() {
  const isReady = started.value !== null;
  return (
    <main class="start">
      <h1>Lumencut</h1>
      <p>See the inside of all vessels of a CT or MR angiography in one view that you can turn freely.</p>
      <ol class="first-steps">
        <li>
          <strong>Open</strong> a scan: drop a DICOM folder or zip archive, NIfTI, NRRD or MetaImage here. You
          can drop its centerlines with it.
        </li>
        <li>
          <strong>Click twice</strong> along a vessel: its centerline is traced, and the vessel is cut open.
        </li>
        <li>
          <strong>Turn it, measure it</strong>, and save the report.
        </li>
      </ol>
      <section class="open-here" aria-label="Open a scan">
        <OpenButtons />
        <p>The scan stays in this browser: nothing leaves your machine.</p>
      </section>
      <h2>Or try it first</h2>
      <p>
        <button type="button" class="primary" disabled={!isReady} onClick={() => void startGuide()}>
          Two-minute guided tour
        </button>
      </p>
      <p>Synthetic phantoms with known centerlines:</p>
      <ul class="phantoms">
        {PHANTOMS.map(([name, words]) => (
          <li key={name}>
            <button type="button" disabled={!isReady} onClick={() => void openPhantom(name)}>
              {words}
            </button>
          </li>
        ))}
      </ul>
      <p class="notice">
        Lumencut is not a medical device. Do not use it for diagnosis.{' '}
        <a href="./THIRD-PARTY-NOTICES.txt">Third-party licences</a>
      </p>
    </main>
  );
}
