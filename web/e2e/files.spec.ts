/** Files that are chosen: centerlines beside what is open, also where nothing tells their space. */
import { expect, test } from '@playwright/test';
import { Viewer } from './page';

/** A line that lies in the phantom just as well where x and y are negated. */
const AXIS = 'x,y,z,radius\n0,0,-8,1.5\n0,0,0,1.5\n0,0,8,1.5\n';

test('centerlines whose space nothing tells are read as the user says', async ({ browser }) => {
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
