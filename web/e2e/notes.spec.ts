/** Notes about vessels that were found show their places; alike notes stand together. */
import { type Browser, type BrowserContextOptions, expect, type Locator, test } from '@playwright/test';
import { serious } from './accessibility';
import { button, rows, SIZE } from './controls';
import { nrrd } from './nrrd';
import { Viewer } from './page';
import { openScan } from './scans';

/** Two tubes of 9 mm radius along the patient, which get darker half way: each may lead into another lumen. */
const changing = nrrd('changing.nrrd', { counts: [84, 40, 96], side: 1, middle: [0, 0, 0] }, (x, y, z) => {
  const noise = ((Math.imul(x * 73 + y * 179 + z * 283, 2_654_435_761) >>> 16) % 40) - 20;
  return (Math.min(Math.hypot(x - 20, y), Math.hypot(x + 20, y)) < 9 ? (z < 0 ? 400 : 280) : -100) + noise;
});

async function found(browser: Browser, options: BrowserContextOptions = {}): Promise<Viewer> {
  const viewer = await Viewer.open(browser, '?device=cpu&test', { viewport: SIZE, ...options });
  await openScan(viewer, changing);
  await button(viewer, 'Find all vessels').last().click();
  await expect(rows(viewer)).toHaveCount(2);
  return viewer;
}

const places = (viewer: Viewer): Locator =>
  viewer.page.locator('footer li', { hasText: '2 places where a vessel changes its brightness' });

test('each note about a place has a button that goes there, and the measurements repeat it', async ({
  browser,
}) => {
  const viewer = await found(browser);
  // The cross-hair is in the section that is shown.
  await expect(viewer.readOut).toContainText(/Vessel \d · 4\d\.\d mm/);
  await viewer.page.locator('footer summary').click();
  await expect(places(viewer)).toBeVisible();
  for (const n of [0, 1]) {
    const place = places(viewer).getByRole('button').nth(n);
    const words = (await place.textContent()) ?? '';
    const [, name, at] = /^(.*), (\d+) mm$/.exec(words) ?? [];
    await expect(place).toHaveAttribute('title', new RegExp(`^Doubtful from ${at} mm on: the brightness`));
    await place.click();
    await expect(viewer.readOut).toContainText(new RegExp(`${name} · (${at}|${Number(at) - 1})\\.`));
  }
  expect(await serious(viewer.page, 'dark')).toEqual([]);
  await viewer.screenshot('notes');
  await viewer.press('Escape');
  await viewer.press('m');
  const doubts = viewer.page.getByTestId('line-doubts');
  await expect(doubts).toContainText('The line: Doubtful from');
  await doubts.getByRole('button', { name: 'Cut there' }).click();
  await expect(rows(viewer)).toHaveCount(3);
  await expect(doubts).toHaveCount(0);
  await viewer.press('Control+z');
  await expect(doubts).toBeVisible();
  viewer.expectNoFault();
  await viewer.close();
});

test('notes work by keyboard and by touch', async ({ browser }) => {
  const viewer = await found(browser, { hasTouch: true });
  await viewer.page.locator('footer summary').focus();
  await viewer.press('Enter');
  const place = places(viewer).getByRole('button').last();
  await place.focus();
  await viewer.press('Enter');
  await expect(viewer.readOut).toContainText(/Vessel \d/);
  await expect(place).toBeVisible();
  await viewer.press('Escape');
  await expect(place).toBeHidden();
  await viewer.page.locator('footer summary').tap();
  await places(viewer).getByRole('button').first().tap();
  await expect(viewer.readOut).toContainText(/Vessel \d/);
  viewer.expectNoFault();
  await viewer.close();
});

test('a doubt about the axes of a scan is shown when it opens', async ({ browser }) => {
  const viewer = await Viewer.open(browser, '?device=cpu', { viewport: SIZE });
  const grid = { counts: [20, 230, 20], side: 1, middle: [0, 0, 0] } as const;
  await openScan(
    viewer,
    nrrd('lying.nrrd', grid, (x) => 10 * x),
  );
  await expect(viewer.page.getByTestId('told')).toContainText(
    'The scan is 230 mm long from front to back, but 20 mm from side to side and 20 mm from foot to head',
  );
  viewer.expectNoFault();
  await viewer.close();
});
