/** Asks in which study the objects of "Save for PACS" belong. */
import { useRef } from 'preact/hooks';
import { askAboutFile, type PacsStudy, savePacs } from '../output/pacs';
import { attempt } from '../output/save-actions';
import { type ChosenFile, chooseFile, setPacsAsked } from '../state/questions';
import { scanStudy } from '../state/store';
import { Question } from './Question';

export function PacsQuestion() {
  const input = useRef<HTMLInputElement>(null);
  const close = () => setPacsAsked(false);
  const save = (study: PacsStudy) => {
    close();
    attempt(() => savePacs(study));
  };
  const isKnown = scanStudy.value?.hasStudy ?? false;
  const first = (button: HTMLButtonElement | null) => button?.focus();
  return (
    <Question label="Save for PACS">
      <p>
        Saves the displayed pictures, the report and the measurements as DICOM in a zip archive. Nothing is
        sent.
        {!isKnown && ' The scan is not DICOM: which study should the objects belong to?'}
      </p>
      {isKnown && (
        <button type="button" ref={first} onClick={() => save('scan')}>
          Save in the study of the scan
        </button>
      )}
      <button
        type="button"
        title="Leaves out patient, study and vessel names, but does not follow the DICOM Basic Confidentiality Profile"
        {...(!isKnown && { ref: first })}
        onClick={() => save('anonymous')}
      >
        Anonymous
      </button>
      <button type="button" onClick={() => input.current?.click()}>
        Choose a DICOM file of the study
      </button>
      <input
        ref={input}
        hidden
        type="file"
        aria-label="DICOM file of the study"
        onChange={({ currentTarget: { files } }) => {
          const [file] = files ?? [];
          if (file) {
            close();
            attempt(() => askAboutFile({ path: file.name, file }));
          }
        }}
      />
      <button type="button" onClick={close}>
        Go back
      </button>
    </Question>
  );
}

export function FileOfStudy({ chosen: { file, facts, doubts, refusal } }: { chosen: ChosenFile }) {
  const close = () => chooseFile(null);
  const words = refusal
    ? `This file cannot be used: ${refusal}.`
    : 'Add the objects to the study of this file?';
  return (
    <Question label="Study of the chosen file">
      <p>{words}</p>
      <dl>
        {facts.map(([label, value]) => (
          <div key={label}>
            <dt>{label}</dt>
            <dd>{value || 'not stated'}</dd>
          </div>
        ))}
      </dl>
      {doubts.length > 0 && (
        <ul>
          {doubts.map((doubt) => (
            <li key={doubt}>{doubt}</li>
          ))}
        </ul>
      )}
      {refusal === null && (
        <button
          type="button"
          onClick={() => {
            close();
            attempt(() => savePacs(file));
          }}
        >
          Save in this study
        </button>
      )}
      <button
        type="button"
        ref={(button) => button?.focus()}
        onClick={() => {
          close();
          setPacsAsked(true);
        }}
      >
        Choose again
      </button>
      <button type="button" onClick={close}>
        Go back
      </button>
    </Question>
  );
}
