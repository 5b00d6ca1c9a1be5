/** Tests of opening files: centerlines for an open scan, also if they state no coordinate system. */
import { expect, test } from '@playwright/test';
import { serious } from './accessibility';
import { button, choose, fileOf, rows, SESSION, saved } from './controls';
import { Viewer } from './page';

/** A centerline that lies in the phantom even if x and y change their signs. */
const AXIS = 'x,y,z,radius\n0,0,-8,1.5\n0,0,0,1.5\n0,0,8,1.5\n';

test('centerlines of unknown coordinate system are read as the user chooses', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu');
  await viewer.rest();
  const chooser = viewer.page.locator('input[type=file]').first();
  await chooser.setInputFiles({ name: 'axis.csv', mimeType: 'text/csv', buffer: Buffer.from(AXIS) });
  const alert = viewer.page.getByRole('alert');
  await expect(alert).toContainText('axis.csv');
  await alert.getByRole('button', { name: 'Read as RAS' }).click();
  await expect(alert).toBeHidden();
  await viewer.rest();
  await expect(viewer.readOut).toContainText('vessel 2 · 8.0 mm');
  viewer.expectNoFault();
  await viewer.close();
});

test('centerlines of unknown coordinate system and unit are read as the user chooses', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu');
  await viewer.rest();
  const chooser = viewer.page.locator('input[type=file]').first();
  const metres = 'x,y,z,radius\n0,0,-0.008,0.0015\n0,0,0,0.0015\n0,0,0.008,0.0015\n';
  await chooser.setInputFiles({ name: 'axis.csv', mimeType: 'text/csv', buffer: Buffer.from(metres) });
  const alert = viewer.page.getByRole('alert');
  await expect(alert).toContainText('16 mm across');
  await alert.getByRole('button', { name: 'Read as RAS in m', exact: true }).click();
  await expect(alert).toBeHidden();
  await viewer.rest();
  await expect(viewer.readOut).toContainText('vessel 2 · 8.0 mm');
  viewer.expectNoFault();
  await viewer.close();
});

function bar(): { name: string; mimeType: string; buffer: Buffer } {
  const sizes = [12, 10, 30] as const;
  const values = new Int16Array(sizes[0] * sizes[1] * sizes[2]);
  values.forEach((_, n) => {
    values[n] = Math.hypot((n % sizes[0]) - 5, (Math.floor(n / sizes[0]) % sizes[1]) - 5) < 3 ? 300 : -50;
  });
  const header = [
    'NRRD0004',
    'type: int16',
    'dimension: 3',
    `sizes: ${sizes.join(' ')}`,
    'endian: little',
    'encoding: raw',
  ];
  const buffer = Buffer.concat([Buffer.from(`${header.join('\n')}\n\n`), Buffer.from(values.buffer)]);
  return { name: 'bar.nrrd', mimeType: 'application/octet-stream', buffer };
}

test('a scan without voxel spacing has mm only if the user assumes them, and undo reverts this', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?device=cpu');
  await expect(viewer.page.getByRole('button', { name: 'Choose files' })).toBeEnabled();
  const line = Buffer.from('x,y,z,radius\n5,5,4,3\n5,5,14,3\n5,5,24,3\n');
  await viewer.page
    .locator('main input[type=file]')
    .first()
    .setInputFiles([bar(), { name: 'line.csv', mimeType: 'text/csv', buffer: line }]);
  await viewer.rest();
  const scale = viewer.pane().getByRole('img', { name: /scale bar of/ });
  const assume = viewer.page.getByRole('button', { name: 'Assume 1 mm' });
  const hair = await viewer.hair('turning');
  await expect(scale).toHaveCount(0);
  await expect(viewer.readOut).not.toContainText('mm');
  await viewer.page.emulateMedia({ colorScheme: 'light' });
  expect(await serious(viewer.page, 'light')).toEqual([]);
  await assume.click();
  await expect(scale).toBeVisible();
  await expect(assume).toHaveCount(0);
  await expect(viewer.readOut).toContainText('10.0 mm');
  expect(await viewer.hair('turning')).toEqual(hair);
  await viewer.screenshot('one-millimetre');
  await viewer.press('Control+z');
  await expect(scale).toHaveCount(0);
  await expect(assume).toBeVisible();
  await viewer.press('Control+y');
  await expect(scale).toBeVisible();
  viewer.expectNoFault();
  await viewer.close();
});

test('assumed voxels of 1 mm are kept in the session, and stated with the measurements', async ({
  browser,
}) => {
  const viewer = await Viewer.open(browser, '?device=cpu', {});
  await expect(button(viewer, 'Choose files')).toBeEnabled();
  const line = fileOf('line.csv', Buffer.from('x,y,z,radius\n5,5,4,3\n5,5,14,3\n5,5,24,3\n'));
  await choose(viewer, bar(), line);
  await viewer.rest();
  expect(JSON.parse(`${await saved(viewer, SESSION)}`).LumencutSession.format).toBe(1);
  await button(viewer, 'Assume 1 mm').click();
  const session = await saved(viewer, SESSION);
  expect(JSON.parse(`${session}`).LumencutSession).toMatchObject({ format: 2, one_millimetre_assumed: true });
  await viewer.page.reload();
  await expect(button(viewer, 'Choose files')).toBeEnabled();
  await choose(viewer, bar());
  await viewer.rest();
  await expect(button(viewer, 'Assume 1 mm')).toBeVisible();
  await choose(viewer, fileOf('saved.mrk.json', session));
  await viewer.rest();
  await viewer.press('v');
  await expect(rows(viewer).first().locator('.length')).toHaveText('20.0 mm');
  await expect(button(viewer, 'Assume 1 mm')).toHaveCount(0);
  await expect(button(viewer, 'Undo')).toBeDisabled();
  await viewer.press('m');
  await expect(viewer.page.getByTestId('section-numbers')).toContainText('mm');
  const words = 'The scan has no voxel spacing: 1 mm is assumed.';
  const numbers = 'Measurements of all measured vessels';
  for (const file of [`${numbers} (CSV)`, `${numbers} (JSON)`, 'Report (HTML)']) {
    expect(`${await saved(viewer, file)}`).toContain(words);
  }
  viewer.expectNoFault();
  await viewer.close();
});
