/** Preview of the report, with buttons to copy and save: sentences and key image of each finding. */
import { useEffect, useState } from 'preact/hooks';
import type { Sentence } from '../core/messages';
import { type Finding, hiddenFindings, listedFindings } from '../measure/findings';
import { mm, unitless } from '../measure/words';
import { copyPicture, copyWords } from '../output/copying';
import { keyImage, keyPicture } from '../output/key-image';
import { askForPacs } from '../output/pacs';
import { saveReport } from '../output/report';
import { attempt } from '../output/save-actions';
import { showBestView, toggleLayout } from '../state/actions';
import { moveTo } from '../state/cross-hair';
import { findingSentences, leaveOut, leftOut } from '../state/measuring';
import { profiles, stopped } from '../state/profiles';
import * as store from '../state/store';
import { ScanNamed } from './SaveMenu';

export function FindingsPanel() {
  const findings = listedFindings.value;
  const distances = findingSentences.value?.distances ?? [];
  return (
    <div class="numbers-panel findings" data-testid="findings">
      {findings.length === 0 && distances.length === 0 ? <Nothing /> : <Head count={findings.length} />}
      {unitless() && <p>{unitless()}</p>}
      {findings.map((finding) => (
        <FindingPart key={finding.line} finding={finding} />
      ))}
      {distances.length > 0 && (
        <section aria-label="Straight distances">
          <h3>Straight distances</h3>
          {distances.map((words) => (
            <p key={words}>{words}</p>
          ))}
        </section>
      )}
      {hiddenFindings.value.length > 0 && (
        <p class="doubts">{`Not in the report, because hidden: ${hiddenFindings.value.join(', ')}.`}</p>
      )}
    </div>
  );
}

function Nothing() {
  return (
    <>
      <p>Findings appear here once you mark a place or a length on a measured vessel.</p>
      <button type="button" onClick={() => toggleLayout('measure')}>
        Measure the picked vessel
      </button>
    </>
  );
}

function Head({ count }: { readonly count: number }) {
  return (
    <div class="vessel-choice">
      <span>{count === 1 ? '1 finding' : `${count} findings`}</span>
      <button
        type="button"
        title="One page for each finding (Ctrl+Shift+s)"
        onClick={() => attempt(saveReport)}
      >
        Save report
      </button>
      <button type="button" onClick={() => attempt(askForPacs)}>
        Save for PACS
      </button>
      <ScanNamed />
    </div>
  );
}

function FindingPart({ finding }: { readonly finding: Finding }) {
  const { line, vessel, length } = finding;
  const name = finding.name || `vessel ${vessel + 1}`;
  const sentences = findingSentences.value?.vessels.find((one) => one.line === line)?.sentences;
  const words = (sentences ?? []).map((sentence) => sentence.words).join(' ');
  return (
    <section aria-label={`Finding on ${name}`}>
      <h3>{`${name}, ${mm(length, 1)}`}</h3>
      {sentences ? sentences.map((one) => <Words key={one.words} sentence={one} />) : <Pending line={line} />}
      {sentences && <KeyImage finding={finding} name={name} />}
      <div class="buttons">
        <button
          type="button"
          title="Moves the section and the view to this finding"
          onClick={() => show(finding)}
        >
          Show
        </button>
        <button
          type="button"
          disabled={!sentences}
          onClick={() => attempt(() => copyWords(`${name}: ${words}`))}
        >
          Copy sentence
        </button>
        <button
          type="button"
          disabled={!sentences}
          onClick={() => attempt(() => copyPicture(keyPicture(finding)))}
        >
          Copy picture
        </button>
        <label>
          <input
            type="checkbox"
            checked={!leftOut.value.has(line)}
            onChange={(event) => leaveOut(line, !event.currentTarget.checked)}
          />
          in the report
        </label>
      </div>
    </section>
  );
}

const CLASSES = { finding: 'graded', doubt: 'doubts', remark: '' } as const;

function Words({ sentence: { kind, words } }: { readonly sentence: Sentence }) {
  return <p class={CLASSES[kind]}>{words}</p>;
}

/** Shown for a vessel that is not measured yet, or cannot be measured. */
function Pending({ line }: { readonly line: number }) {
  const known = profiles.value.get(line);
  if (known && 'failure' in known) {
    return (
      <p class="refused">{`Not measured: found ${known.failure.found}; expected ${known.failure.expected}.`}</p>
    );
  }
  return <p>{stopped.value === line ? 'Not measured: stopped.' : 'Measuring…'}</p>;
}

/** The key image of a finding; redrawn when marks, window or measurements change. */
function KeyImage({ finding, name }: { readonly finding: Finding; readonly name: string }) {
  const [address, setAddress] = useState<string | null>(null);
  const window = store.window_.value;
  useEffect(() => {
    let isWanted = true;
    attempt(async () => {
      const canvas = await keyImage(finding);
      if (isWanted) {
        setAddress(canvas.toDataURL('image/png'));
      }
    });
    return () => {
      isWanted = false;
    };
  }, [finding.marks, finding.line, finding.name, profiles.value.get(finding.line), window]);
  return address && <img src={address} alt={`Straightened vessel and sections of ${name}`} />;
}

function show({ vessel, marks, length }: Finding): void {
  store.pickVessel(vessel);
  moveTo(marks.at ?? marks.references[0] ?? marks.stretch?.[0] ?? length / 2);
  void showBestView();
}
