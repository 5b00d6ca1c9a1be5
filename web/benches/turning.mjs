/**
 * Pictures while a view turns, in Chromium: `node web/benches/turning.mjs ADDRESS [CHROMIUM]`.
 *
 * ADDRESS is printed by `lumencut view --no-browser`. The main view is dragged to and fro for three seconds and released.
 */
import { chromium } from '@playwright/test';

const SECONDS = 3;
const [address, executablePath = '/usr/bin/chromium'] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu'] });
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const canvas = page.locator('canvas[data-stage]');

const begun = performance.now();
await page.goto(address);
await canvas.waitFor();
console.log(`first picture after ${Math.round(performance.now() - begun)} ms`);
await atRest();
await page.evaluate(recordPictures);

const { x, y, width, height } = await canvas.boundingBox();
const middle = [x + width / 2, y + height / 2];
await page.mouse.move(...middle);
await page.mouse.down();
for (let gone = 0, start = performance.now(); gone < SECONDS; gone = (performance.now() - start) / 1000) {
  await page.mouse.move(middle[0] + 200 * Math.sin(3 * gone), middle[1] + 20 * Math.sin(2 * gone));
  await page.waitForTimeout(8);
}
await page.mouse.up();
const released = await page.evaluate(() => performance.now());
await atRest();

const pictures = await page.evaluate(() => globalThis.pictures);
const moving = pictures.filter(({ at }) => at < released);
const full = pictures.find(({ at, size }) => at > released && size[0] >= Math.floor(width));
const sides = moving.map(({ size }) => Math.min(...size)).sort((a, b) => a - b);
console.log(
  `${(moving.length / SECONDS).toFixed(1)} pictures a second; shorter side ${median(sides)} pixels (median)`,
);
console.log(`full resolution ${Math.round(full.at - released)} ms after the release`);
await browser.close();

function atRest() {
  return page.waitForFunction(() => document.querySelector('canvas[data-stage]').dataset.last === 'true');
}

function recordPictures() {
  const canvas = document.querySelector('canvas[data-stage]');
  const put = CanvasRenderingContext2D.prototype.putImageData;
  globalThis.pictures = [];
  CanvasRenderingContext2D.prototype.putImageData = function (picture, ...at) {
    if (this.canvas === canvas) {
      globalThis.pictures.push({ at: performance.now(), size: [picture.width, picture.height] });
    }
    return put.call(this, picture, ...at);
  };
}

function median(sorted) {
  return sorted[Math.floor(sorted.length / 2)];
}
