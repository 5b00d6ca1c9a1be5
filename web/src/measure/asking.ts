/** Requests measurements from the engine whenever the marks or the picked vessel change. */

import { untracked, useSignalEffect } from '@preact/signals';
import { useRef } from 'preact/hooks';
import { Failure } from '../core/failure';
import { Latest } from '../core/latest';
import type { LineId, Profile } from '../core/messages';
import { moveTo } from '../state/cross-hair';
import type { VesselMarks } from '../state/document';
import { document_ } from '../state/history';
import {
  type Answers,
  endArriving,
  isArriving,
  NO_ANSWERS,
  NOTHING_SUGGESTED,
  type Suggested,
  takeAnswers,
  takeSentences,
} from '../state/measuring';
import { beingMeasured, forgetProfiles, measure, profiles, renewProfile, stopped } from '../state/profiles';
import { rulerLength } from '../state/rulers';
import { listedLines, tree } from '../state/shown';
import * as store from '../state/store';
import { engine } from '../worker/engine';
import { currentMarks, currentProfile, currentVessel } from './current';
import { listedFindings, markedVessel, stated } from './findings';
import { comparedIn, mainPlace, placesOf } from './marks';

/** Keeps all measurements of the picked vessel up to date. Only the layout uses this hook. */
export function useMeasuring(): void {
  const latest = useRef(new Latest());
  const latestFindings = useRef(new Latest());
  const answered = useRef<LineId | null>(null);
  const lines = useRef('');
  const drawn = useRef(new Map<LineId, string>());
  useSignalEffect(() => {
    // A profile depends on all vessels, even hidden ones, because it excludes sections at branches.
    const now = listedLines.value;
    if (now !== lines.current) {
      lines.current = now;
      untracked(forgetProfiles);
    }
  });
  useSignalEffect(() => {
    // Profiles contain the contours that were drawn by hand.
    for (const { line, contours } of tree.value) {
      const text = JSON.stringify(contours);
      const before = drawn.current.get(line) ?? '[]';
      drawn.current.set(line, text);
      if (text !== before && untracked(() => profiles.value.has(line))) {
        renewProfile(line).catch(unlessGone);
      }
    }
  });
  useSignalEffect(() => {
    const known = profiles.value;
    const line = wantedLines().find((one) => !known.has(one));
    // Both signals are read in any case, so that a change of either runs this effect again.
    const isFree = beingMeasured.value === null && store.hasVolume.value;
    if (line !== undefined && isFree && stopped.value !== line) {
      void measure(line);
    }
  });
  useSignalEffect(arrive);
  useSignalEffect(() => askForSentences(latestFindings.current));
  useSignalEffect(() => {
    const [vessel, profile, marks] = [currentVessel.value, currentProfile.value, currentMarks.value];
    if (vessel?.line !== answered.current) {
      // Numbers of one vessel must not appear next to the name of another.
      answered.current = vessel?.line ?? null;
      takeAnswers(NO_ANSWERS);
    }
    if (vessel && profile && marks) {
      latest.current.run(async () => {
        const found = await asked(vessel.line, profile, marks).catch(unlessGone);
        // The user may have picked another vessel meanwhile.
        if (found && currentVessel.value?.line === vessel.line) {
          takeAnswers(found);
        }
      });
    } else {
      takeAnswers(NO_ANSWERS);
    }
  });
}

/** Lines to measure: in the report those of all findings, while measuring that of the picked vessel. */
function wantedLines(): readonly LineId[] {
  if (store.layout.value === 'report') {
    return listedFindings.value.map(({ line }) => line);
  }
  const vessel = currentVessel.value;
  return vessel && store.layout.value === 'measure' ? [vessel.line] : [];
}

function askForSentences(latest: Latest): void {
  if (store.layout.value !== 'report') {
    return;
  }
  const message = {
    vessels: listedFindings.value.filter(({ line }) => isMeasured(line)).map(markedVessel),
    distances: document_.value.rulers.map(rulerLength),
    stated: stated(),
  };
  latest.run(async () => {
    takeSentences(await engine.ask('findings', message).catch(unlessGone));
  });
}

const isMeasured = (line: LineId): boolean => 'profile' in (profiles.value.get(line) ?? {});

/** After the user opened measuring, moves the section to the narrowest place once it is known. */
function arrive(): void {
  const [profile, marks] = [currentProfile.value, currentMarks.value];
  if (isArriving.value && store.layout.value === 'measure' && profile && marks) {
    const main = mainPlace(profile, marks);
    untracked(() => {
      endArriving();
      if (main) {
        moveTo(main.at);
      }
    });
  }
}

/** Ignores lines that an edit replaced meanwhile. */
export function unlessGone(error: unknown): null {
  if (Failure.of(error).kind === 'vessel tree') {
    return null;
  }
  throw error;
}

export async function asked(line: LineId, profile: Profile, marks: VesselMarks): Promise<Answers> {
  const [suggested, { stenosis, not_graded, narrower }, stretches] = await Promise.all([
    offeredBeside(line, marks),
    engine.ask('grade', { line, marks }),
    stretchesOf(line, marks),
  ]);
  const compared = comparedIn(placesOf(profile, marks, suggested));
  const references = compared?.references.map(({ at }) => at) ?? [];
  const doubts =
    stenosis || !compared
      ? (stenosis?.doubts ?? [])
      : await engine.ask('doubts', { line, compared: { at: compared.at, references, method: marks.method } });
  return { suggested, stenosis, notGraded: not_graded, narrower, doubts, ...stretches };
}

async function offeredBeside(line: LineId, marks: VesselMarks): Promise<Suggested> {
  try {
    return await engine.ask('offered_references', { line, marks });
  } catch {
    // A place that was not measured has no suggestions; grading reports the reason.
    return NOTHING_SUGGESTED;
  }
}

async function stretchesOf(
  line: LineId,
  { stretch, secondStretch }: VesselMarks,
): Promise<Pick<Answers, 'stretch' | 'secondStretch' | 'angle'>> {
  const [first, second, angle] = await Promise.all([
    stretch && engine.ask('stretch', { line, ends: stretch }),
    secondStretch && engine.ask('stretch', { line, ends: secondStretch }),
    stretch && secondStretch && engine.ask('angle_between', { line, first: stretch, second: secondStretch }),
  ]);
  return { stretch: first, secondStretch: second, angle };
}
