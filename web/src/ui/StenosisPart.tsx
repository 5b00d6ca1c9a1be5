/** The marked stenosis. The percentage never appears without its method, its references and diameters in mm. */
import type { StenosisMethod, Territory } from '../core/messages';
import { STENOSIS_METHODS } from '../core/method-names';
import { currentMarks, currentPlaces } from '../measure/current';
import { changeMarks, confirmAll } from '../measure/editing';
import { notGradedWords, stenosisWords, withKnownUnits } from '../measure/words';
import { saveReport } from '../output/report';
import { attempt } from '../output/save-actions';
import type { VesselMarks } from '../state/document';
import { answers } from '../state/measuring';

export function StenosisPart() {
  const marks = currentMarks.value;
  if (!marks) {
    return null;
  }
  return (
    <section aria-label="Stenosis">
      <h3>Stenosis</h3>
      <Result marks={marks} />
      <Doubts />
      <button type="button" class="save-report" onClick={() => attempt(saveReport)}>
        Save report
      </button>
      <div class="fields">
        <label>
          Method
          <select
            value={marks.method}
            onChange={(event) =>
              set('choose the method', { method: event.currentTarget.value as StenosisMethod })
            }
          >
            {STENOSIS_METHODS.map(([name, words]) => (
              <option key={name} value={name}>
                {words}
              </option>
            ))}
          </select>
        </label>
        {marks.method === 'ecst' && (
          <Length
            name="Original diameter"
            title="Diameter of the vessel before the stenosis formed, as ECST defines it (mm)"
            value={marks.original}
            onGive={(original) => set('enter the original diameter', { original })}
          />
        )}
        {marks.method === 'nascet' && (
          <Length
            name="Contralateral"
            title="Diameter of the same artery on the other side (mm); needed to detect a near-occlusion"
            value={marks.comparison}
            onGive={(comparison) => set('enter the contralateral diameter', { comparison })}
          />
        )}
        <label title="Reports the severity group of NASCET (carotid) or CAD-RADS 2.0 (coronary)">
          Severity group
          <select
            value={marks.group ?? ''}
            onChange={(event) =>
              set('choose the severity group', {
                group: (event.currentTarget.value || null) as Territory | null,
              })
            }
          >
            <option value="">none</option>
            <option value="carotid">carotid</option>
            <option value="coronary">coronary</option>
          </select>
        </label>
      </div>
    </section>
  );
}

function set(words: string, some: Partial<VesselMarks>): void {
  changeMarks(words, (marks) => ({ ...marks, ...some }));
}

function Result({ marks }: { readonly marks: VesselMarks }) {
  const { stenosis } = answers.value;
  if (stenosis) {
    return (
      <div role="status" data-testid="stenosis">
        <p class="graded">{stenosisWords(stenosis)}</p>
        {stenosis.group && <p>{`Severity group: ${withKnownUnits(stenosis.group)}`}</p>}
      </div>
    );
  }
  return <NotGraded marks={marks} />;
}

/** Doubts about the percentage; if nothing is marked, about the suggested places. */
function Doubts() {
  const { doubts } = answers.value;
  return doubts.length > 0 ? (
    <p class="doubts" data-testid="doubts">
      {doubts.join(' ')}
    </p>
  ) : null;
}

const NOTHING_MARKED = 'Nothing is marked.';
const CHECK_SUGGESTIONS = 'Check the suggested places, drag them where they belong, or confirm them.';

/** A hint, not an error, and therefore shown without emphasis. */
const ONLY_REFERENCES = 'Only a reference is marked. Press "Narrowest here" to get a percentage.';

function NoPercentage({ marks }: { readonly marks: VesselMarks }) {
  return marks.at === null ? (
    <p>{ONLY_REFERENCES}</p>
  ) : (
    <p class="refused">{notGradedWords(answers.value)}</p>
  );
}

function NotGraded({ marks }: { readonly marks: VesselMarks }) {
  const suggestions = currentPlaces.value.filter((place) => place.isSuggestion);
  const isMarked = marks.at !== null || marks.references.length > 0;
  return (
    <div role="status" data-testid="stenosis">
      {isMarked ? (
        <NoPercentage marks={marks} />
      ) : (
        <p>{suggestions.length > 0 ? `${NOTHING_MARKED} ${CHECK_SUGGESTIONS}` : NOTHING_MARKED}</p>
      )}
      {suggestions.length > 0 && (
        <button type="button" onClick={confirmAll}>
          {suggestions.length === 1 ? 'Confirm the suggested place' : 'Confirm the suggested places'}
        </button>
      )}
    </div>
  );
}

interface LengthProps {
  readonly name: string;
  readonly title?: string;
  readonly value: number | null;
  onGive(value: number | null): void;
}

function Length({ name, title, value, onGive }: LengthProps) {
  return (
    <label title={title}>
      {name}
      <span>
        <input
          class="number"
          type="number"
          min="0"
          max="100"
          step="any"
          value={value === null ? '' : String(value)}
          onChange={(event) => {
            const number = Number(event.currentTarget.value);
            onGive(number > 0 ? number : null);
          }}
        />{' '}
        mm
      </span>
    </label>
  );
}
