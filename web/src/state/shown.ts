/** Keeps the displayed tree equal to the visible vessels of the document, except doubtful ones. */

import { batch, effect, signal, untracked } from '@preact/signals';
import { Failure } from '../core/failure';
import type {
  AfterEdit,
  DocumentVessel,
  ListedLine,
  Message,
  Report,
  VesselDocument,
} from '../core/messages';
import type { Window } from '../core/plain';
import { engine } from '../worker/engine';
import { nameOf, shownVessels } from './changes';
import { moveTo } from './cross-hair';
import { type Document, EMPTY } from './document';
import { answered, editQueue } from './edit-queue';
import { begin, document_, setGiven } from './history';
import * as store from './store';
import { active } from './tool';

/** The displayed vessels, in the order of `store.report.value.vessels`. */
export const tree = signal<readonly DocumentVessel[]>([]);

/** Identifies the set of all lines that affect measurements, including hidden ones. */
export const listedLines = signal('');
const linesOf = (vessels: readonly DocumentVessel[]): string =>
  listOf(vessels)
    .map(({ line }) => line)
    .join();

export const toPick = signal<number | null>(null);

export function pickWhenShown(id: number | undefined): void {
  toPick.value = id ?? toPick.value;
}

/** Picks a vessel, and its point at half its length, once the vessel is displayed. */
export function pickOnceShown(id: number): void {
  const vessel = tree.value.findIndex((one) => one.id === id);
  batch(() => {
    toPick.value = vessel < 0 ? id : null;
    if (vessel >= 0) {
      store.pickedVessel.value = vessel;
      store.pickedPlace.value = (store.report.value?.vessels?.[vessel]?.length ?? 0) / 2;
    }
  });
}

/** Picks a vessel, and moves the cross-hair to a place on it (mm), by default to half its length. A vessel that is not shown stays. */
export function goToVessel(id: number, at: number | null): void {
  const vessel = tree.value.findIndex((one) => one.id === id);
  if (vessel >= 0) {
    store.pickVessel(vessel);
    moveTo(at ?? (store.report.value?.vessels?.[vessel]?.length ?? 0) / 2);
  }
}

export const pickedId = (): number | null => tree.value[store.pickedVessel.value ?? -1]?.id ?? null;

const listOf = (vessels: readonly DocumentVessel[]): readonly ListedLine[] =>
  vessels
    .filter((vessel) => vessel.doubt === null)
    .map((vessel) => {
      const { line, isHidden, contours } = vessel;
      return { line, name: nameOf(vessel), hidden: isHidden, contours };
    });
/** What the engine shows of a document. */
const shownOf = ({ vessels, bone_hidden, dark }: VesselDocument): Message<'show'> => ({
  lines: listOf(vessels),
  bone_hidden,
  dark,
});
const textOf = (document: VesselDocument): string => JSON.stringify(shownOf(document));

let shownText = textOf(EMPTY);

/** Begins the document of a new study. Its vessels are already displayed, and there is nothing to undo. */
export function beginStudy(vessels: VesselDocument | null): void {
  editQueue.drop();
  const document = { ...EMPTY, ...vessels };
  batch(() => {
    active.value = null;
    tree.value = document.vessels;
    listedLines.value = linesOf(document.vessels);
    shownText = textOf(document);
    begin(document);
    setGiven(document);
  });
}

/** Replaces the document of the open study, for example by a session. This cannot be undone. */
export function beginDocument(document: Document): void {
  editQueue.drop();
  batch(() => {
    active.value = null;
    begin(document);
  });
}

export function showAgain(): Promise<void> {
  shownText = '';
  return show();
}

/** Displays the tree whenever the document changes. Returns a function that stops this. */
export function followDocument(): () => void {
  let lastAnswer: AfterEdit | null = answered.peek();
  return effect(() => {
    const [document, answer] = [document_.value, answered.value];
    if (answer && answer !== lastAnswer) {
      shownText = textOf(answer.edited.document);
    }
    if (textOf(document) !== shownText) {
      void show();
    } else if (answer && answer !== lastAnswer) {
      untracked(() => {
        const study = store.report.value?.volume;
        takeUp(answer.report, document).catch((error) => reportError(study, error));
      });
    }
    lastAnswer = answer;
  });
}

async function takeUp(report: Report, document: Document): Promise<void> {
  const isLeft = batch(() => {
    listedLines.value = linesOf(document.vessels);
    return take(report, shownVessels(document));
  });
  if (isLeft) {
    await goOn();
  }
}

function reportError(study: Report['volume'] | undefined, error: unknown): void {
  if (study === store.report.value?.volume) {
    store.problem.value = Failure.of(error);
  }
}

let showing: Promise<void> | null = null;

/** Requests displayed trees from the engine, one at a time, until the latest document is displayed. */
function show(): Promise<void> {
  showing ??= showLatest();
  return showing;
}

async function showLatest(): Promise<void> {
  // Wait, so that the caller has set `showing` before this function ends.
  await null;
  let study = store.report.value?.volume;
  try {
    while (study) {
      const document = document_.value;
      const text = textOf(document);
      if (text === shownText) {
        break;
      }
      const report = await engine.ask('show', shownOf(document));
      if (study === store.report.value?.volume) {
        shownText = text;
        await takeUp(report, document);
      }
      study = store.report.value?.volume;
    }
  } catch (error) {
    reportError(study, error);
  } finally {
    // Cleared without an `await`, so that no change can be missed after the last check.
    showing = null;
  }
}

/** Stores the new tree; keeps camera, cross-hair and picked vessel. Returns whether the cross-hair lost its vessel. */
function take(report: Report, vessels: readonly DocumentVessel[]): boolean {
  const picked = store.pickedVessel.value;
  const lengths = (report.vessels ?? []).map((vessel) => vessel.length);
  // Picks the longest vessel if none was picked, unless one is being drawn.
  const isFirst = picked === null && vessels.every((vessel) => vessel.id !== active.value);
  const wanted = vessels.findIndex(({ id }) => id === toPick.value);
  const longest = () => lengths.indexOf(Math.max(...lengths));
  const before = () => (isFirst && lengths.length > 0 ? longest() : successor(tree.value, picked, vessels));
  const now = wanted >= 0 ? wanted : before();
  const hair = store.crossHair.value;
  batch(() => {
    if (hair && hair.vessel !== null) {
      const id = tree.value[hair.vessel]?.id;
      const vessel = vessels.findIndex((one) => one.id === id);
      store.crossHair.value = vessel < 0 ? { ...hair, vessel: null, arcLength: null } : { ...hair, vessel };
    }
    const isSame = picked !== null && now !== null && tree.value[picked]?.id === vessels[now]?.id;
    tree.value = vessels;
    // The volume must stay the same object, because views reset their position for a new one.
    followWindow(store.report.value?.windows?.main, report.windows?.main);
    store.report.value = { ...report, volume: store.report.value?.volume ?? report.volume };
    store.pickedVessel.value = now;
    toPick.value = wanted >= 0 ? null : toPick.value;
    const length = lengths[now ?? -1] ?? 0;
    store.pickedPlace.value = isSame ? Math.min(store.pickedPlace.value, length) : length / 2;
  });
  return (hair?.vessel ?? null) !== null && store.crossHair.value?.vessel === null && now !== null;
}

/** Moves the cross-hair to the section of the newly picked vessel. */
async function goOn(): Promise<void> {
  const [vessel, at] = [store.pickedVessel.value, store.pickedPlace.value];
  if (vessel !== null) {
    const [point] = await engine.ask('across', { vessel, at });
    const { value } = await engine.ask('at', point);
    store.crossHair.value = { point, value, vessel, arcLength: at };
  }
}

/** Uses the newly suggested window, unless the user has chosen another one. */
function followWindow(before: Window | undefined, after: Window | undefined): void {
  const isOwn = before === undefined || before.some((value, n) => value !== store.window_.value[n]);
  if (after && !isOwn) {
    store.window_.value = after;
  }
}

/** The vessel to pick: the one being drawn, else the one picked before, else the next one, else the last one. */
export function successor(
  before: readonly DocumentVessel[],
  picked: number | null,
  after: readonly DocumentVessel[],
): number | null {
  const placeOf = (id: number | null | undefined) => after.findIndex((vessel) => vessel.id === id);
  const drawn = placeOf(active.value);
  if (drawn >= 0 || after.length === 0) {
    return drawn >= 0 ? drawn : null;
  }
  const following = picked === null ? [] : before.slice(picked);
  const kept = following.map((vessel) => placeOf(vessel.id)).find((place) => place >= 0);
  return kept ?? (picked === null ? 0 : after.length - 1);
}
