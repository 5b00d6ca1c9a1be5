import { SAVED_CENTERLINES } from '../core/generated/tables';
import { currentProfile } from '../measure/current';
import { listedFindings } from '../measure/findings';
import { askForPacs } from '../output/pacs';
import { savePng } from '../output/pictures';
import { saveReport } from '../output/report';
import { attempt, hasCenterlines, saveCenterlines, saveSession } from '../output/save-actions';
import { saveNumbers } from '../output/tables';
import { saveFilm, savePictures } from '../output/turntable';
import { isKeeping, isScanNamed, setKeeping, setScanNamed } from '../state/questions';
import { isCompanion } from '../state/two-scans';
import { keepWithin, useClosing } from './closing-menu';

export function SaveMenu() {
  const isMeasured = currentProfile.value !== null;
  return (
    <details class="menu" onToggle={keepWithin} ref={useClosing()}>
      <summary>Save</summary>
      <div class="menu-body">
        {(isMeasured || listedFindings.value.length > 0) && <Report />}
        <Choice
          words="For PACS (DICOM, zip)"
          title="Pictures, report and measurements as DICOM objects of the scan's study, in a zip archive; nothing is sent"
          save={askForPacs}
        />
        <Choice
          words="Session (JSON)"
          title="Vessels, marks and views, to continue later: open the scan first, then the session"
          save={saveSession}
        />
        {!isCompanion.value && <Keeping />}
        {hasCenterlines() &&
          SAVED_CENTERLINES.map((kind) => (
            <Choice key={kind} words={`Centerlines (.${kind})`} save={() => saveCenterlines(kind)} />
          ))}
        {isMeasured && (
          <>
            <Choice words="Measurements of all measured vessels (CSV)" save={() => saveNumbers('csv')} />
            <Choice words="Measurements of all measured vessels (JSON)" save={() => saveNumbers('json')} />
          </>
        )}
        <Choice words="Picture with labels (PNG)" save={() => savePng('labels')} />
        <Choice words="Picture without labels (PNG)" save={() => savePng('plain')} />
        <Choice words="Turntable (WebM)" save={saveFilm} />
        <Choice words="Turntable (PNGs)" save={savePictures} />
        {!isMeasured && <small>To save a report or measurements, measure a vessel first.</small>}
      </div>
    </details>
  );
}

interface ChoiceProps {
  readonly words: string;
  readonly title?: string;
  save(): Promise<void>;
}

function Choice({ words, title, save }: ChoiceProps) {
  return (
    <button type="button" {...(title && { title })} onClick={() => attempt(save)}>
      {words}
    </button>
  );
}

function Keeping() {
  return (
    <label title="Stores vessels, marks and views, but no pixels, on this computer until the tab is closed">
      <input
        type="checkbox"
        checked={isKeeping.value}
        onChange={(event) => setKeeping(event.currentTarget.checked)}
      />
      Keep the session when this tab reloads
    </label>
  );
}

function Report() {
  return (
    <>
      <Choice words="Report (HTML)" save={saveReport} />
      <ScanNamed />
    </>
  );
}

/** Checkbox that decides whether reports contain the name of the scan. */
export function ScanNamed() {
  return (
    <label class="with-name">
      <input
        type="checkbox"
        checked={isScanNamed.value}
        onChange={(event) => setScanNamed(event.currentTarget.checked)}
      />
      include the name of the scan
    </label>
  );
}
