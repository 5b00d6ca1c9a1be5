/** Sends requests from the worker to the engine. Requests and answers are JSON; bytes are passed separately. */
import { transfer } from 'comlink';
import { Failure } from '../core/failure';
import { TURNS } from '../core/generated/questions';
import type { Answer, Attachments, Bytes, Edit, Message, OnProgress, Question } from '../core/messages';
import { Engine } from '../core/module';
import type { KindOf } from '../io/kinds';

const NO_FILE = new Uint8Array();

export function ask<N extends Question>(
  engine: Engine,
  name: N,
  message: Message<N>,
  { bytes = NO_FILE, onProgress }: Attachments = {},
): Answer<N> {
  const words = wordsOf(name, message);
  if (words) {
    onProgress?.({ words, done: 0, total: null });
  }
  return answer(
    engine.ask(name, JSON.stringify(message), bytes, words && onProgress ? hearing(words, onProgress) : null),
  );
}

/** Progress labels of slow edits; the label of all other edits is "Tracing". */
const EDITS: Partial<Record<Edit['kind'], string>> = {
  add_branches: 'Finding branches',
  add_mask: 'Tracing the mask',
  add_whole_vessel: 'Finding vessels',
  find_vessels: 'Finding vessels',
  hide_bone: 'Finding bone',
};

function wordsOf<N extends Question>(name: N, message: Message<N>): string | null {
  const edit = name === 'edit' ? (message as Message<'edit'>).edit : null;
  return (edit && EDITS[edit.kind]) ?? TURNS[name].words;
}

export function askAtOnce<N extends Question>(name: N, message: Message<N>): Answer<N> {
  return answer(Engine.ask_at_once(name, JSON.stringify(message)));
}

/** Names the kind of a file. */
export const kindOf: KindOf = (head, name) => askAtOnce('kind_of_file', { head, name });

export const isAtOnce = (name: Question): boolean => TURNS[name].when === 'at once';

/** Throws if long work was cancelled before it began. */
export function refuseStopped(name: Question, signal: AbortSignal): void {
  if (TURNS[name].words !== null && signal.aborted) {
    throw new Failure('interrupted', 'tracing', 'a stop', 'a complete run');
  }
}

/** Lets the bytes of an answer be transferred to the page instead of copied. */
export function moved<T>(given: T): T {
  const { bytes } = (given ?? {}) as { bytes?: Bytes };
  return bytes ? transfer(given, [bytes.buffer]) : given;
}

function answer<T>(given: readonly unknown[]): T {
  const [json, bytes] = given as [string, Bytes?];
  const answer = JSON.parse(json);
  return bytes ? { ...answer, bytes } : answer;
}

function hearing(words: string, onProgress: OnProgress): (share: number) => void {
  return (share) => onProgress({ words, done: Math.round(100 * share), total: 100 });
}
