/** Closing a scan and opening another. */
import { expect, test } from '@playwright/test';
import { drop, fileOf, nameOf, rename } from './controls';
import { SIZE } from './measured-tube';
import { Viewer } from './page';
import { tubes } from './scans';

test('the page asks before it closes unsaved work, and measuring does not continue in the next scan', async ({
  browser,
}) => {
  const tube = await Viewer.open(browser, '?phantom=stenosis&device=cpu', { viewport: SIZE });
  const { page } = tube;
  await tube.rest();
  const close = page.getByRole('button', { name: 'Close the scan' });
  const question = page.getByRole('alertdialog');
  await tube.press('v');
  await rename(tube, 0, 'narrowed');
  await tube.press('m');
  await expect(page.getByRole('progressbar', { name: 'Measuring the vessel' })).toBeVisible();
  await close.click();
  await expect(question).toContainText('Discard 1 vessel that was not saved?');
  await expect(question.getByRole('button', { name: 'Go back' })).toBeFocused();
  await tube.press('Escape');
  await expect(question).toHaveCount(0);
  await expect(nameOf(tube, 0)).toHaveValue('narrowed');
  await page.getByRole('button', { name: 'Ruler' }).click();
  await close.click();
  await question.getByRole('button', { name: 'Discard' }).click();
  await expect(page.getByRole('heading', { name: 'Lumencut' })).toBeVisible();
  await page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
  await expect(page.locator('main.layout')).toHaveAttribute('data-layout', 'strip');
  await tube.rest();
  await expect(page.getByRole('alert')).toHaveCount(0);
  // Nothing has changed since it was saved, so it closes without a question, even while a tool is active.
  await tube.press('m', 't');
  await expect(page.locator('main.layout')).toHaveAttribute('data-layout', 'four');
  await close.click();
  await page.getByRole('button', { name: 'A tube with a stenosis of 50 %' }).click();
  await expect(page.locator('main.layout')).toHaveAttribute('data-layout', 'strip');
  await expect(page.getByRole('button', { name: 'Trace', exact: true })).toHaveAttribute(
    'aria-pressed',
    'false',
  );
  await tube.rest();
  await expect(page.getByRole('alert')).toHaveCount(0);
  tube.expectNoFault();
  await tube.close();
});

test('a file that cannot be opened asks nothing; questions come one at a time, and Escape answers them', async ({
  browser,
}) => {
  const tube = await Viewer.open(browser, '?phantom=stenosis&device=cpu', { viewport: SIZE });
  const question = tube.page.getByRole('alertdialog');
  await tube.rest();
  await tube.press('v');
  await rename(tube, 0, 'narrowed');
  await drop(tube, fileOf('notes.txt', Buffer.from('patient was late')));
  await expect(tube.problem).toContainText('notes.txt');
  await expect(question).toHaveCount(0);
  await tube.problem.getByRole('button', { name: 'Close' }).click();
  await tube.page.getByRole('button', { name: 'Close the scan' }).click();
  await expect(question).toContainText('Discard');
  await drop(tube, tubes('tubes.nrrd'));
  await tube.screenshot('one-question');
  await expect(question).toHaveCount(1);
  await expect(question).toContainText('Discard');
  await tube.pane().click();
  await tube.press('Escape');
  await expect(question).toContainText('What is tubes.nrrd?');
  // Its grid is not that of the scan, so the answer that works has the focus.
  await expect(question.getByRole('button', { name: 'Open as a new scan' })).toBeFocused();
  await expect(question.getByRole('button', { name: 'Use as a mask of vessels' })).toBeDisabled();
  await tube.press('Escape');
  await expect(question).toHaveCount(0);
  await expect(nameOf(tube, 0)).toHaveValue('narrowed');
  tube.expectNoFault();
  await tube.close();
});
