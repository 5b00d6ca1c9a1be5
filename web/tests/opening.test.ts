import { beforeEach, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { GivenFile } from '../src/core/messages';
import { EMPTY } from '../src/state/document';
import { begin } from '../src/state/history';
import { openWith } from '../src/state/opened';
import { closeProblem, problem, report } from '../src/state/store';
import { takeFiles } from '../src/study/opening';
import { connect } from '../src/worker/engine';

const given = (name: string, text = ''): GivenFile => ({ path: name, file: new File([text], name) });
const SESSION = given('work.json', '{"LumencutSession": {}}');
const later = () => new Promise((resolve) => setTimeout(resolve));

let asked: string[] = [];
let end: () => void = () => {};

function rejecting(): void {
  asked = [];
  const reject = (name: string) => {
    asked.push(name);
    return Promise.reject(new Failure('format', name, 'nothing', 'a file'));
  };
  connect({
    openFiles: ([first]: readonly GivenFile[]) => reject(String(first?.path)),
    ask: (name: string) =>
      name === 'report' ? Promise.resolve({ volume: null, vessels: null }) : reject(name),
  } as never);
}

beforeEach(() => {
  begin(EMPTY);
  report.value = null;
  rejecting();
  closeProblem();
  const opening = new Promise<void>((resolve) => {
    end = resolve;
  });
  void openWith({}, () => opening);
});

test.each([
  ['session', SESSION, 'read_session'],
  ['centerlines', given('lines.vtp'), 'lines.vtp'],
])('a %s file waits for the scan that is opening', async (_, file, expected) => {
  const taken = takeFiles([file]);
  await later();
  expect(asked).toEqual([]);
  end();
  await taken;
  expect(asked).toContain(expected);
  expect(problem.value?.subject).toBe(expected);
});

test('a new scan does not wait for the scan that it replaces', async () => {
  await takeFiles([given('scan.nrrd')]);
  expect(asked).toContain('scan.nrrd');
});
