/** After a crash of the engine, the page reports it and can still save the session. */
import { expect, test } from '@playwright/test';
import { button, choose, fileOf, rows, SESSION, SIZE, saved, startTracing } from './controls';
import { Viewer } from './page';
import { NARROWED, openScan, traceTube, tubes } from './scans';

const SCAN = tubes('tubes.nrrd');

/** Makes the next request to the engine fail like a crash of the WebAssembly module. */
async function crash(viewer: Viewer): Promise<void> {
  // The first worker is the engine; the others are its threads.
  await viewer.page.workers()[0]?.evaluate(() => {
    const { stringify } = JSON;
    JSON.stringify = () => {
      JSON.stringify = stringify;
      throw new WebAssembly.RuntimeError('unreachable');
    };
  });
}

test('after a crash the message offers to save the session, which restores the traced vessels', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  await openScan(viewer, SCAN);
  await startTracing(viewer);
  await traceTube(viewer, NARROWED, [28, -28], 1);
  await button(viewer, 'End this vessel').click();
  await button(viewer, 'Done').click();
  await viewer.rest();
  const before = JSON.parse((await saved(viewer, SESSION)).toString('utf-8'));

  await crash(viewer);
  await viewer.drag([0.3, 0.4], [60, 25]);
  const message = viewer.page.getByRole('alert');
  await expect(message).toContainText('Found a crash: unreachable; expected an answer.');
  const download = viewer.page.waitForEvent('download');
  await message.getByRole('button', { name: 'Save the session' }).click();
  const stream = await (await download).createReadStream();
  const bytes = Buffer.concat(await stream.toArray());
  const { view: _, ...session } = JSON.parse(bytes.toString('utf-8')).LumencutSession;
  const { view: __, ...expected } = before.LumencutSession;
  expect(session).toEqual(expected);

  await viewer.page.reload();
  await openScan(viewer, SCAN);
  await viewer.press('v');
  await choose(viewer, fileOf('lumencut-session.mrk.json', bytes));
  await expect(rows(viewer)).toHaveCount(1);
  await viewer.close();
});
