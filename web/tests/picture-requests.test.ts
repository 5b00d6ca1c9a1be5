/** Tests that a pane never shows an old picture under a new label. */
import { describe, expect, test } from 'vitest';
import { Failure } from '../src/core/failure';
import type { Pair, Picture } from '../src/core/messages';
import { PictureRequests } from '../src/pane/picture-requests';

const SIZE: Pair = [2, 2];
const PICTURE: Picture = { size: SIZE, bytes: new Uint8ClampedArray(16) };

const soon = () => new Promise((resolve) => setTimeout(resolve, 0));

function pane() {
  const log: string[] = [];
  const requests = new PictureRequests({
    show: (_, label) => log.push(label),
    rest: () => log.push('rest'),
    fail: (error) => log.push(Failure.of(error).kind),
  });
  const asked: { readonly label: string; answer(): void; fail(kind: 'interrupted' | 'volume'): void }[] = [];
  const want = (label: string) =>
    requests.want({
      label,
      size: SIZE,
      ask: () =>
        new Promise<Picture>((resolve, reject) => {
          const fail = (kind: 'interrupted' | 'volume') => reject(new Failure(kind, 'a', 'b', 'c'));
          asked.push({ label, answer: () => resolve(PICTURE), fail });
        }),
    });
  const shut = () => requests.want(null);
  return { log, asked, want, shut };
}

describe('PictureRequests', () => {
  test('a picture has the label that it was asked with, and the last wish comes last', async () => {
    const { log, asked, want } = pane();
    want('thin');
    want('MIP 10 mm');
    want('MIP 20 mm');
    asked[0]?.answer();
    await soon();
    expect(log).toEqual(['thin']);
    asked[1]?.answer();
    await soon();
    expect(asked.map(({ label }) => label)).toEqual(['thin', 'MIP 20 mm']);
    expect(log).toEqual(['thin', 'MIP 20 mm', 'rest']);
  });

  test('a picture that other work interrupted is asked for again', async () => {
    const { log, asked, want } = pane();
    want('thin');
    asked[0]?.answer();
    await soon();
    want('MIP 20 mm');
    asked[1]?.fail('interrupted');
    await soon();
    expect(log).toEqual(['thin', 'rest']);
    asked[2]?.answer();
    await soon();
    expect(log).toEqual(['thin', 'rest', 'MIP 20 mm', 'rest']);
  });

  test('the same picture in another size is not at rest before it arrives', async () => {
    const { log, asked, want } = pane();
    want('thin');
    want('thin');
    asked[0]?.answer();
    await soon();
    expect(log).toEqual(['thin']);
    asked[1]?.answer();
    await soon();
    expect(log).toEqual(['thin', 'thin', 'rest']);
  });

  test('failures of older wishes, and answers after the pane is shut, are ignored', async () => {
    const { log, asked, want, shut } = pane();
    want('thin');
    want('MIP 20 mm');
    asked[0]?.fail('volume');
    await soon();
    expect(log).toEqual([]);
    asked[1]?.fail('volume');
    await soon();
    expect(log).toEqual(['volume', 'rest']);
    want('mean 20 mm');
    shut();
    asked[2]?.answer();
    await soon();
    expect(log).toEqual(['volume', 'rest', 'rest']);
  });
});
