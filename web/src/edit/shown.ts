/** The tree that is shown follows the document: the visible vessels, without the doubtful ones, whenever they change. */
import { batch, effect, signal, untracked } from '@preact/signals';
import type { Asked } from '../core/asked';
import { Failure } from '../core/failure';
import type { AfterEdit, DocumentVessel, ListedLine, Report, VesselDocument } from '../core/messages';
import type { Window } from '../core/plain';
import { shownVessels } from '../state/changes';
import { type Document, EMPTY } from '../state/document';
import { begin, document_ } from '../state/history';
import * as store from '../state/store';
import { active } from '../state/tool';
import { answered, dropEdits } from './committing';

/** The vessels of the tree that is shown: those of `store.report`, in the same order. */
export const tree = signal<readonly DocumentVessel[]>([]);

/** The lines that vessels are measured among, in their order: also those of vessels that are hidden. */
export const listedLines = signal('');
const linesOf = (vessels: readonly DocumentVessel[]): string =>
  listOf(vessels)
    .map(({ line }) => line)
    .join();

/** A vessel that is picked as soon as it is shown. */
export const toPick = signal<number | null>(null);

/** Picks a vessel of the document, at half its length: now where it is shown, else as soon as it is. */
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

/** The vessel of the document that is picked. */
export const pickedId = (): number | null => tree.value[store.pickedVessel.value ?? -1]?.id ?? null;

/** What is asked of a list of vessels: lines and names, and which of them are hidden. */
const listOf = (vessels: readonly DocumentVessel[]): readonly ListedLine[] =>
  vessels
    .filter((vessel) => vessel.doubt === null)
    .map(({ line, name, isHidden }) => ({ line, name, hidden: isHidden }));
const textOf = (vessels: readonly DocumentVessel[]): string => JSON.stringify(listOf(vessels));

let shownText = textOf([]);

/** Another study, or none: the document begins with its vessels, which are shown already, and nothing can be undone. */
export function beginStudy(vessels: VesselDocument | null): void {
  dropEdits();
  const document = { ...EMPTY, ...vessels };
  batch(() => {
    active.value = null;
    tree.value = document.vessels;
    listedLines.value = linesOf(document.vessels);
    shownText = textOf(document.vessels);
    begin(document);
  });
}

/** Another document of the same study, as from a session: nothing can be undone. */
export function beginDocument(document: Document): void {
  dropEdits();
  batch(() => {
    active.value = null;
    begin(document);
  });
}

/** The engine shows another tree than the document has: what the document has is shown again. */
export function showAgain(engine: Asked): Promise<void> {
  shownText = '';
  return show(engine);
}

/** Shows the document's tree from now on; gives what ends it. */
export function followDocument(engine: Asked): () => void {
  let heard: AfterEdit | null = answered.peek();
  return effect(() => {
    const [document, answer] = [document_.value, answered.value];
    if (answer && answer !== heard) {
      shownText = textOf(answer.edited.document.vessels);
    }
    if (textOf(document.vessels) !== shownText) {
      void show(engine);
    } else if (answer && answer !== heard) {
      untracked(() => {
        const study = store.report.value?.volume;
        takeUp(engine, answer.report, document).catch((error) => tellOf(study, error));
      });
    }
    heard = answer;
  });
}

/** The store tells what the engine shows of a document; the cross-hair goes on where its vessel is gone. */
async function takeUp(engine: Asked, report: Report, document: Document): Promise<void> {
  const isLeft = batch(() => {
    listedLines.value = linesOf(document.vessels);
    return take(report, shownVessels(document));
  });
  if (isLeft) {
    await goOn(engine);
  }
}

/** Tells what went wrong, unless it was asked of a study that is closed meanwhile. */
function tellOf(study: Report['volume'] | undefined, error: unknown): void {
  if (study === store.report.value?.volume) {
    store.problem.value = Failure.of(error);
  }
}

let showing: Promise<void> | null = null;

/** One tree is asked for at a time; where the document changes meanwhile, the latest one follows. Ends when that is shown. */
function show(engine: Asked): Promise<void> {
  showing ??= showLatest(engine);
  return showing;
}

async function showLatest(engine: Asked): Promise<void> {
  // What is shown is known to be under way before it can end.
  await null;
  let study = store.report.value?.volume;
  try {
    while (study) {
      const document = document_.value;
      const text = textOf(document.vessels);
      if (text === shownText) {
        break;
      }
      const report = await engine.ask('show', listOf(document.vessels));
      if (study === store.report.value?.volume) {
        shownText = text;
        await takeUp(engine, report, document);
      }
      study = store.report.value?.volume;
    }
  } catch (error) {
    tellOf(study, error);
  } finally {
    // Here and not later: no change comes between the last look at the document and this.
    showing = null;
  }
}

/**
 * The store tells the new tree; camera and cross-hair stay, and so does the vessel that is picked. Gives whether the cross-hair was
 * on a vessel that is gone while another one is picked now.
 */
function take(report: Report, vessels: readonly DocumentVessel[]): boolean {
  const picked = store.pickedVessel.value;
  const lengths = (report.vessels ?? []).map((vessel) => vessel.length);
  // Where none was picked the longest is, unless one is being drawn.
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
    // The volume stays the one that it was, so that views of it keep what they look at.
    followWindow(store.report.value?.windows?.main, report.windows?.main);
    store.report.value = { ...report, volume: store.report.value?.volume ?? report.volume };
    store.pickedVessel.value = now;
    toPick.value = wanted >= 0 ? null : toPick.value;
    const length = lengths[now ?? -1] ?? 0;
    store.pickedPlace.value = isSame ? Math.min(store.pickedPlace.value, length) : length / 2;
  });
  return (hair?.vessel ?? null) !== null && store.crossHair.value?.vessel === null && now !== null;
}

/** The cross-hair goes on to the section of the vessel that is picked now, so that all views are of one vessel. */
async function goOn(engine: Asked): Promise<void> {
  const [vessel, at] = [store.pickedVessel.value, store.pickedPlace.value];
  if (vessel !== null) {
    const [point] = await engine.ask('across', { vessel, at });
    const { value } = await engine.ask('at', point);
    store.crossHair.value = { point, value, vessel, arcLength: at };
  }
}

/** The window that the data suggest follows the vessels where the reader has chosen no other one. */
function followWindow(before: Window | undefined, after: Window | undefined): void {
  const isOwn = before === undefined || before.some((value, n) => value !== store.window_.value[n]);
  if (after && !isOwn) {
    store.window_.value = after;
  }
}

/** The vessel that is drawn; else the one that was picked, the next one that is still there, or the last one. */
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
