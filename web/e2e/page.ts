/** Operates the page as a user would, and records all errors that occur in it. */
import {
  type Browser,
  type BrowserContextOptions,
  expect,
  type Locator,
  type Page,
  type ViewportSize,
} from '@playwright/test';
import { GESTURES } from '../src/core/generated/tables';
import type { Answer, Asked, Camera, Message, Pair, Question, Report } from '../src/core/messages';
import { stateOf, type ViewState } from '../src/state/address';
import type { Pixels } from './compare';

export type PaneName = 'turning' | 'axial' | 'coronal' | 'sagittal' | 'straightened' | 'section' | 'profile';

interface TestHook extends Asked {
  memory(): Promise<number>;
}

const THEME = 'dark';
/** Conditions are checked at this interval (ms); the default is every frame, which makes the page draw frames. */
const POLLING = { polling: 50 };
/** Idle pages of each browser, by the options of their context; they show a small file, without an engine. */
const IDLE = 'icon.svg';
const idle = new WeakMap<Browser, Map<string, Viewer[]>>();

export class Viewer {
  readonly faults: string[] = [];
  /** Position of the last click, and the time (ms) until which another click there is a double click. */
  private lastClick: { readonly at: Pair; readonly until: number } = { at: [0, 0], until: 0 };
  private own = '';

  private constructor(
    readonly page: Page,
    private readonly viewport: ViewportSize | null,
    private readonly pool: Viewer[],
  ) {}

  /** Opens the page, in an idle one if there is one, since a new context compiles the WebAssembly; `query` begins with `?` or `#`. */
  static async open(browser: Browser, query = '', options: BrowserContextOptions = {}): Promise<Viewer> {
    const { viewport, colorScheme = THEME, baseURL = pageAddress(), ...context } = options;
    const pools = idle.get(browser) ?? new Map<string, Viewer[]>();
    idle.set(browser, pools);
    const kind = JSON.stringify(context);
    const pool = pools.get(kind) ?? [];
    pools.set(kind, pool);
    const viewer = pool.pop() ?? (await Viewer.made(browser, context, pool));
    const { page } = viewer;
    viewer.own = new URL(baseURL).origin;
    viewer.faults.length = 0;
    const size = viewport ?? viewer.viewport;
    if (size) {
      await page.setViewportSize(size);
    }
    await page.emulateMedia({ colorScheme });
    await page.goto(new URL(query || '.', baseURL).href);
    return viewer;
  }

  private static async made(
    browser: Browser,
    options: BrowserContextOptions,
    pool: Viewer[],
  ): Promise<Viewer> {
    const context = await browser.newContext(options);
    const page = await context.newPage();
    const viewer = new Viewer(page, page.viewportSize(), pool);
    await viewer.guard();
    return viewer;
  }

  private async guard(): Promise<void> {
    const context = this.page.context();
    const isForeign = ({ origin, protocol }: URL) => /^(http|ws)s?:$/.test(protocol) && origin !== this.own;
    await context.route(isForeign, (route) => {
      this.faults.push(`request to ${route.request().url()}`);
      return route.abort();
    });
    await context.routeWebSocket(isForeign, (socket) => {
      this.faults.push(`socket to ${socket.url()}`);
    });
    context.on('weberror', (error) => this.faults.push(`error: ${error.error().message}`));
    context.on('console', (message) => {
      if (message.type() === 'error') {
        this.faults.push(`console: ${message.text()}`);
      }
    });
  }

  expectNoFault(): void {
    expect(this.faults).toEqual([]);
  }

  /** Ends the use of the page by a test, and removes all that the test has changed in it. */
  async close(): Promise<void> {
    const { page } = this;
    await page.unrouteAll({ behavior: 'ignoreErrors' });
    page.removeAllListeners('dialog');
    await page.mouse.move(0, 0);
    this.own = new URL(pageAddress()).origin;
    await page.goto(new URL(IDLE, this.own).href);
    await page.evaluate(() => {
      localStorage.clear();
      sessionStorage.clear();
    });
    this.lastClick = { at: [0, 0], until: 0 };
    this.pool.push(this);
  }

  pane(name: PaneName = 'turning'): Locator {
    return this.page.getByTestId(name);
  }

  get readOut(): Locator {
    return this.page.getByTestId('readout');
  }

  get window(): Locator {
    return this.page.getByTestId('window');
  }

  get device(): Locator {
    return this.page.getByTestId('device');
  }

  get problem(): Locator {
    return this.page.getByRole('alert');
  }

  /** Waits for two frames, since the requests that follow a change start only after the next frame. */
  async frames(): Promise<void> {
    await this.page.evaluate(
      () =>
        new Promise((resolve) =>
          requestAnimationFrame(() => setTimeout(() => requestAnimationFrame(resolve), 30)),
        ),
    );
  }

  async rest(): Promise<void> {
    await this.frames();
    await this.page.waitForFunction(
      () => document.querySelector<HTMLElement>('canvas.picture')?.dataset.last === 'true',
      null,
      POLLING,
    );
  }

  async state(): Promise<ViewState> {
    await this.frames();
    await this.page.waitForFunction(
      () => document.documentElement.dataset.address === 'written',
      null,
      POLLING,
    );
    const state = stateOf(new URL(this.page.url()).hash);
    expect(state).not.toBeNull();
    return state ?? {};
  }

  async camera(): Promise<Camera> {
    const { camera } = await this.state();
    const size = await this.size();
    if (!camera) {
      throw new Error('the address tells no camera');
    }
    return { ...camera, size, pixel_spacing: (camera.pixel_spacing * camera.height) / Math.min(...size) };
  }

  async size(name: PaneName = 'turning'): Promise<Pair> {
    return this.pane(name).evaluate((pane) => [pane.clientWidth, pane.clientHeight]);
  }

  async box(name: PaneName = 'turning') {
    const box = await this.pane(name).boundingBox();
    if (!box) {
      throw new Error(`the view ${name} is not shown`);
    }
    return box;
  }

  /** Converts a position in a pane to CSS pixels of the page; values below 1 are shares of the pane size. */
  async place([x, y]: Pair, name: PaneName = 'turning'): Promise<Pair> {
    const box = await this.box(name);
    return [
      box.x + (x < 1 ? Math.round(x * box.width) : x),
      box.y + (y < 1 ? Math.round(y * box.height) : y),
    ];
  }

  async drag(from: Pair, [dx, dy]: Pair, options: DragOptions = {}): Promise<void> {
    const { mouse, keyboard } = this.page;
    const [x, y] = await this.place(from, options.pane);
    if (options.modifier) {
      await keyboard.down(options.modifier);
    }
    await mouse.move(x, y);
    await mouse.down({ button: options.button ?? 'left' });
    await mouse.move(x + dx, y + dy, { steps: 4 });
    if (!options.isHeld) {
      await mouse.up({ button: options.button ?? 'left' });
    }
    if (options.modifier) {
      await keyboard.up(options.modifier);
    }
  }

  async click(at: Pair, name: PaneName = 'turning'): Promise<void> {
    const [x, y] = await this.place(at, name);
    const { at: last, until } = this.lastClick;
    if (Math.hypot(x - last[0], y - last[1]) <= GESTURES.double_near) {
      await this.page.waitForTimeout(Math.max(0, until - Date.now()));
    }
    await this.page.mouse.click(x, y);
    this.lastClick = { at: [x, y], until: Date.now() + GESTURES.double_within };
    await this.frames();
  }

  async tap(at: Pair, name: PaneName = 'turning'): Promise<void> {
    await this.page.touchscreen.tap(...(await this.place(at, name)));
    await this.frames();
  }

  async doubleClick(at: Pair, name: PaneName = 'turning'): Promise<void> {
    const [x, y] = await this.place(at, name);
    await this.page.mouse.dblclick(x, y);
    await this.frames();
  }

  async wheel(at: Pair, by: number, name: PaneName = 'turning'): Promise<void> {
    const [x, y] = await this.place(at, name);
    await this.page.mouse.move(x, y);
    await this.page.mouse.wheel(0, by);
  }

  async press(...keys: readonly string[]): Promise<void> {
    for (const key of keys) {
      await this.page.keyboard.press(key);
    }
  }

  async pin([width, height]: Pair): Promise<void> {
    await this.page.addStyleTag({
      content: `[data-testid=turning] { position: absolute; width: ${width}px; height: ${height}px; inset: 0 auto auto 0; }`,
    });
    await this.page.waitForFunction(
      (size) => {
        const pixels = size.map((count) => count * window.devicePixelRatio).join('x');
        return document.querySelector<HTMLElement>('canvas.picture')?.dataset.pixels === pixels;
      },
      [width, height],
      POLLING,
    );
  }

  async research(work: () => Promise<unknown>): Promise<void> {
    const summary = this.page.getByText('Research', { exact: true });
    await summary.click();
    await work();
    await summary.click();
  }

  field(words: string): Locator {
    const label = this.page.locator('.toolbar label, .looks label', { hasText: new RegExp(`^${words}`) });
    return label.locator('select, input');
  }

  /** Presses the key of a named view, and waits for the orientation letters of that view. */
  async look(key: string, left: string, top: string): Promise<void> {
    await this.press(key);
    await expect(this.pane().locator('.edge.left')).toHaveText(left);
    await expect(this.pane().locator('.edge.top')).toHaveText(top);
    await this.rest();
  }

  reset(): Promise<void> {
    return this.look('r', 'R', 'S');
  }

  async pixels(name: PaneName = 'turning'): Promise<Pixels> {
    const { width, height, text } = await this.pane(name).locator('canvas').evaluate(readCanvas);
    return { width, height, bytes: Buffer.from(text, 'base64') };
  }

  stage(): Promise<string | null> {
    return this.pane().locator('canvas').getAttribute('data-stage');
  }

  async picture(): Promise<Pixels> {
    await this.rest();
    return this.pixels();
  }

  /** Centre of the cross-hair (CSS pixels from the top left). */
  async hair(name: PaneName): Promise<Pair> {
    return this.pane(name)
      .locator('.hair')
      .evaluate((hair: SVGElement) => [
        Number.parseFloat(hair.style.left),
        Number.parseFloat(hair.style.top),
      ]);
  }

  memory(): Promise<number> {
    return this.page.evaluate(() => (window as unknown as { lumencutTest: TestHook }).lumencutTest.memory());
  }

  report(): Promise<Report> {
    return this.ask('report', null);
  }

  /** Sends a request to the engine; returns its answer or throws its failure. */
  ask<N extends Question>(name: N, message: Message<N>): Promise<Answer<N>> {
    const asked = JSON.stringify([name, message]);
    return this.page.evaluate(`window.lumencutTest.ask(...${asked})`) as Promise<Answer<N>>;
  }

  async screenshot(name: string): Promise<void> {
    if (process.env.LUMENCUT_SCREENS) {
      await this.page.screenshot({ path: `test-results/screens/${name}.png` });
    }
  }
}

interface DragOptions {
  readonly pane?: PaneName;
  readonly button?: 'left' | 'middle' | 'right';
  readonly modifier?: 'Shift' | 'Control' | 'Alt';
  readonly isHeld?: boolean;
}

/** Reads size and pixels of a canvas; this function runs in the page. */
function readCanvas(canvas: HTMLElement | SVGElement): { width: number; height: number; text: string } {
  const { width, height } = canvas as HTMLCanvasElement;
  const copy = new OffscreenCanvas(width, height).getContext('2d');
  copy?.drawImage(canvas as HTMLCanvasElement, 0, 0);
  const bytes = copy?.getImageData(0, 0, width, height).data ?? new Uint8ClampedArray();
  let text = '';
  for (let n = 0; n < bytes.length; n += 4096) {
    text += String.fromCharCode(...bytes.subarray(n, n + 4096));
  }
  return { width, height, text: btoa(text) };
}

export function pageAddress(): string {
  return `http://127.0.0.1:${process.env.LUMENCUT_E2E_PORT}/`;
}

export function viewFragment(state: object): string {
  return `#v1=${encodeURIComponent(JSON.stringify(state))}`;
}
