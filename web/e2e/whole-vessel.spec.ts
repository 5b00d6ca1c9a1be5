/** One click traces a whole vessel, from its parent vessel to its end. */
import { expect, test } from '@playwright/test';
import { button, countInput, expectBegun, nameOf, rows, startTracing, untraced } from './controls';
import type { Viewer } from './page';

/** Positions in the coronal slice: to the right of its centre and downwards, in units of the pane height. */
const TRUNK = [0, 0.8] as const;
const RIGHT = [-0.19, 0.22] as const;
const LEFT = [0.19, 0.22] as const;
const AIR = [0.4, 0.5] as const;

async function at(viewer: Viewer, [across, down]: readonly [number, number]) {
  const [width, height] = await viewer.size('coronal');
  return [Math.round(width / 2 + across * height), Math.round(down * height)] as const;
}

const ghost = (viewer: Viewer) => viewer.pane('coronal').getByTestId('whole-vessel');

test('a vessel and its branch take two actions each: a click and Enter', async ({ browser }) => {
  const viewer = await untraced(browser);
  await startTracing(viewer);
  const counted = await countInput(viewer);
  for (const [n, place] of [TRUNK, RIGHT].entries()) {
    await viewer.click(await at(viewer, place), 'coronal');
    await expectBegun(viewer);
    // The first use searches all vessels; afterwards a click previews its whole vessel.
    await expect(ghost(viewer)).toHaveCount(n > 0 ? 1 : 0);
    await viewer.press('Enter');
    await expect(rows(viewer)).toHaveCount(n + 1);
    await expect(rows(viewer).nth(n).getByRole('radio')).toBeChecked();
    await viewer.screenshot(`whole-vessel-${n}`);
  }
  const { clicks, keys } = await counted();
  expect([clicks, keys]).toEqual([2, 2]);
  await button(viewer, 'Done').click();
  await viewer.rest();
  await viewer.screenshot('whole-vessel-done');
  await viewer.press('Control+z');
  await expect(rows(viewer)).toHaveCount(1);
  viewer.expectNoFault();
  await viewer.close();
});

test('a double click or the button traces the whole vessel, and a second click elsewhere traces to that point', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  await startTracing(viewer);
  await viewer.doubleClick(await at(viewer, TRUNK), 'coronal');
  await expect(rows(viewer)).toHaveCount(1);
  await viewer.press('Control+z');
  await viewer.click(await at(viewer, RIGHT), 'coronal');
  await button(viewer, 'Whole vessel').click();
  await expect(rows(viewer)).toHaveCount(1);
  await expect(nameOf(viewer, 0)).toHaveValue('Vessel 1');
  await viewer.click(await at(viewer, TRUNK), 'coronal');
  await expectBegun(viewer);
  await viewer.click(await at(viewer, LEFT), 'coronal');
  await expect(rows(viewer)).toHaveCount(2);
  await expect(button(viewer, 'Whole vessel')).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});

test('by keys only: Enter twice at the cross-hair, and the key w', { tag: '@long' }, async ({ browser }) => {
  const viewer = await untraced(browser);
  await startTracing(viewer);
  await viewer.click(await at(viewer, TRUNK), 'coronal');
  await expectBegun(viewer);
  await viewer.press('Backspace');
  await expect(button(viewer, 'Whole vessel')).toHaveCount(0);
  await viewer.press('Enter');
  await expectBegun(viewer);
  await viewer.press('Enter');
  await expect(rows(viewer)).toHaveCount(1);
  await viewer.press('Control+z');
  await expect(rows(viewer)).toHaveCount(0);
  await viewer.press('Enter');
  await expectBegun(viewer);
  await viewer.press('w');
  await expect(rows(viewer)).toHaveCount(1);
  viewer.expectNoFault();
  await viewer.close();
});

test('a vessel that is already traced there is picked; if there is none, the page drops the point', async ({
  browser,
}) => {
  const viewer = await untraced(browser);
  await startTracing(viewer);
  await viewer.doubleClick(await at(viewer, TRUNK), 'coronal');
  await expect(rows(viewer)).toHaveCount(1);
  await viewer.doubleClick(await at(viewer, RIGHT), 'coronal');
  await expect(rows(viewer).nth(1).getByRole('radio')).toBeChecked();
  await viewer.click(await at(viewer, [0.005, 0.75]), 'coronal');
  await viewer.press('w');
  await expect(viewer.problem).toContainText('a vessel that is already traced');
  await expect(rows(viewer)).toHaveCount(2);
  await expect(rows(viewer).first().getByRole('radio')).toBeChecked();
  await expect(button(viewer, 'Whole vessel')).toHaveCount(0);
  await viewer.press('Escape');
  await viewer.click(await at(viewer, AIR), 'coronal');
  await expect(viewer.problem).toBeVisible();
  await expect(button(viewer, 'Whole vessel')).toHaveCount(0);
  viewer.expectNoFault();
  await viewer.close();
});
