/** Opens the phantom tube, with a stenosis at 30 mm, in the layout for measuring. */
import { readFileSync } from 'node:fs';
import { type Browser, expect, type Locator } from '@playwright/test';
import { saved, stenosis } from './controls';
import { Viewer } from './page';

export const expected = (name: string): string =>
  readFileSync(new URL(`./expected/${name}`, import.meta.url), 'utf-8');
export const PYTHON = JSON.parse(expected('measuring.json'));
export const SIZE = { width: 1280, height: 800 };

const measured = new WeakMap<Browser, MeasuredTube>();

export class MeasuredTube {
  private constructor(readonly viewer: Viewer) {}

  /** Opens the tube, or takes the one that tests of another file measured, without marks. */
  static async open(browser: Browser): Promise<MeasuredTube> {
    const tube = measured.get(browser) ?? (await MeasuredTube.made(browser));
    measured.set(browser, tube);
    await tube.reset();
    return tube;
  }

  private static async made(browser: Browser): Promise<MeasuredTube> {
    const viewer = await Viewer.open(browser, '?phantom=stenosis&device=cpu', { viewport: SIZE });
    const tube = new MeasuredTube(viewer);
    await viewer.rest();
    await viewer.press('m');
    await expect(tube.row('place-0')).toBeVisible();
    const at = `${PYTHON.narrowest[0].toFixed(1)} mm`;
    await expect(viewer.page.getByTestId('section-numbers')).toContainText(at);
    await expect(viewer.readOut).toContainText(at);
    return tube;
  }

  private async reset(): Promise<void> {
    const { page } = this.viewer;
    this.viewer.faults.length = 0;
    await page.setViewportSize(SIZE);
    await this.nothingMarked();
    await this.row('place-0').getByRole('button', { name: 'narrowest place' }).click();
    await expect(page.getByTestId('section-numbers')).toContainText(`${PYTHON.narrowest[0].toFixed(1)} mm`);
    await this.viewer.rest();
  }

  row(name: string): Locator {
    return this.viewer.page.getByTestId(`row-${name}`);
  }

  stenosis(): Locator {
    return stenosis(this.viewer);
  }

  button(name: string | RegExp): Locator {
    return this.viewer.page.getByRole('button', { name });
  }

  handle(place: string, where: string): Locator {
    return this.button(new RegExp(`^${place}.*, ${where}$`));
  }

  tick(text: string): Locator {
    const ticks = this.viewer.page.locator('.profile-chart text[text-anchor=middle]');
    return ticks.filter({ hasText: new RegExp(`^${text}$`) });
  }

  async middleOf(locator: Locator): Promise<[number, number]> {
    const box = await locator.boundingBox();
    if (!box) {
      throw new Error('it is not shown');
    }
    return [box.x + box.width / 2, box.y + box.height / 2];
  }

  async dragBy(of: Locator, [dx, dy]: readonly [number, number]): Promise<void> {
    const { mouse } = this.viewer.page;
    const [x, y] = await this.middleOf(of);
    await mouse.move(x, y);
    await mouse.down();
    await mouse.move(x + dx / 2, y + dy / 2, { steps: 3 });
    await mouse.move(x + dx, y + dy, { steps: 3 });
    await mouse.up();
  }

  /** How many pixels of the chart a length (mm) takes; the vessel is 60 mm long. */
  async pixels(mm: number): Promise<number> {
    const [from, to] = await Promise.all([this.middleOf(this.tick('0')), this.middleOf(this.tick('60'))]);
    return ((to[0] - from[0]) * mm) / 60;
  }

  /** Pixels per mm in the section view, which shows 50 mm. */
  async sectionPixels(): Promise<number> {
    return Math.min(...(await this.viewer.size('section'))) / 50;
  }

  async arcLength(name: string): Promise<number> {
    const words = (await this.row(name).textContent()) ?? '';
    return Number.parseFloat(/ at ([\d.]+) mm/.exec(words)?.[1] ?? '');
  }

  async nothingMarked(): Promise<void> {
    for (const name of ['place-0', 'reference-0', 'reference-1']) {
      const remove = this.row(name).getByRole('button', { name: /^Remove/ });
      if (await remove.isVisible()) {
        await remove.click();
      }
    }
    await expect(this.row('place-0')).toContainText('(suggestion)');
  }

  /** Marks the stenosis at 30 mm and references at 10 and 50 mm, by keys only. */
  async marked(): Promise<void> {
    await this.nothingMarked();
    await this.movedByKeys('place-0', this.handle('(narrowest|marked) place', 'in the profile'), 30, 'Right');
    await this.movedByKeys('reference-0', this.handle('reference before', 'in the CPR'), 10, 'Right');
    await this.movedByKeys('reference-1', this.handle('reference after', 'on the vessel'), 50, 'Down');
  }

  private async movedByKeys(
    row: string,
    handle: Locator,
    to: number,
    ahead: 'Right' | 'Down',
  ): Promise<void> {
    // Retried, since the suggestion may still move after the previous change.
    await expect(async () => {
      const steps = Math.round(2 * (to - (await this.arcLength(row))));
      const back = { Right: 'Left', Down: 'Up' }[ahead];
      const key = `Arrow${steps < 0 ? back : ahead}`;
      const count = Math.abs(steps);
      await handle.focus();
      await this.viewer.press(
        ...Array<string>(Math.floor(count / 10)).fill(`Shift+${key}`),
        ...Array<string>(count % 10).fill(key),
      );
      expect(await this.arcLength(row)).toBe(to);
    }).toPass();
    await expect(this.row(row)).toContainText(`at ${to.toFixed(1)} mm`);
  }

  async saved(name: string): Promise<string> {
    return (await saved(this.viewer, name)).toString('utf-8');
  }
}
