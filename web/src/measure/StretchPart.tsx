/** Marked stretches of a vessel: their length, and the C-arm angles that show them without foreshortening. */

import type { Pair, Profile, Stretch } from '../core/messages';
import { middle } from '../core/vectors';
import type { VesselMarks } from '../state/document';
import { flyTo } from '../state/flight';
import { answers } from '../state/measuring';
import * as store from '../state/store';
import { currentMarks } from './current';
import { changeMarks } from './editing';
import { stretchAround } from './marks';
import { COLORS } from './PlaceHandles';
import { centerAt } from './sections';
import { degrees, mm, NOTHING } from './words';

type Which = 'stretch' | 'secondStretch';

export function StretchPart({ profile }: { readonly profile: Profile }) {
  const marks = currentMarks.value;
  if (!marks) {
    return null;
  }
  const { stretch, secondStretch, angle } = answers.value;
  return (
    <section aria-label="Stretch">
      <h3>Stretch</h3>
      {marks.stretch && stretch && (
        <Numbers which="stretch" ends={marks.stretch} stretch={stretch} profile={profile} />
      )}
      {marks.secondStretch && secondStretch && (
        <Numbers which="secondStretch" ends={marks.secondStretch} stretch={secondStretch} profile={profile} />
      )}
      {angle !== null && <p data-testid="angle">{`Angle between both: ${degrees(angle)}`}</p>}
      <MarkButton marks={marks} profile={profile} />
    </section>
  );
}

function MarkButton({ marks, profile }: { readonly marks: VesselMarks; readonly profile: Profile }) {
  if (marks.secondStretch) {
    return null;
  }
  const which: Which = marks.stretch ? 'secondStretch' : 'stretch';
  const mark = () =>
    changeMarks('mark a stretch', (before) => ({
      ...before,
      [which]: stretchAround(profile, store.pickedPlace.value),
    }));
  return (
    <button type="button" onClick={mark}>
      {which === 'stretch' ? 'Mark a stretch' : 'Mark a second stretch'}
    </button>
  );
}

interface NumbersProps {
  readonly which: Which;
  readonly ends: Pair;
  readonly stretch: Stretch;
  readonly profile: Profile;
}

function Numbers({ which, ends, stretch, profile }: NumbersProps) {
  const remove = () =>
    changeMarks('remove a stretch', (marks) =>
      which === 'stretch'
        ? { ...marks, stretch: marks.secondStretch, secondStretch: null }
        : { ...marks, secondStretch: null },
    );
  return (
    <div class="stretch" data-testid={which}>
      <span
        class="in-colour"
        style={{ '--colour': COLORS[which] }}
      >{`${ends[0].toFixed(1)} to ${mm(ends[1], 1)}`}</span>
      <button type="button" class="small" aria-label="Remove the stretch" onClick={remove}>
        ×
      </button>
      <p>
        {`length ${mm(stretch.length, 1)}, straight ${mm(stretch.straight, 1)}, tortuosity ${stretch.tortuosity?.toFixed(3) ?? NOTHING}`}
      </p>
      {store.states.value.orientation && (
        <p>
          {`C-arm ${stretch.c_arm} `}
          <button type="button" onClick={() => turnThere(stretch, ends, profile)}>
            Turn the view there
          </button>
        </p>
      )}
    </div>
  );
}

function turnThere({ view }: Stretch, ends: Pair, profile: Profile): void {
  const camera = store.camera.value;
  const points = ends.map((at) => centerAt(profile, at)).filter((point) => point !== null);
  if (camera) {
    flyTo({
      ...camera,
      direction: view.direction,
      up: view.up,
      center: points.length > 0 ? middle(points) : camera.center,
    });
  }
}
