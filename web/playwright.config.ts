import { spawnSync } from 'node:child_process';
import { defineConfig } from '@playwright/test';

/** A free port, passed on to the test processes. */
function freePort(): string {
  const script =
    "const s=require('net').createServer().listen(0,'127.0.0.1',()=>{console.log(s.address().port);s.close()})";
  return spawnSync(process.execPath, ['-e', script], { encoding: 'utf-8' }).stdout.trim();
}

const docs = process.env.LUMENCUT_DOCS_SITE;

/** Slow tests that rarely fail: run only by `npm run check-long`. */
const LONG = /@long/;
/** Tests that would repeat the same on the GPU. */
const CPU_ONLY = /@cpu/;
const isLong = Boolean(process.env.LUMENCUT_LONG);

process.env.LUMENCUT_E2E_PORT ??= freePort();
const port = process.env.LUMENCUT_E2E_PORT;
const plain = ['--no-sandbox', '--disable-background-networking', '--no-first-run'];
const gpu = [
  '--enable-unsafe-webgpu',
  '--enable-features=Vulkan',
  '--use-vulkan=swiftshader',
  '--use-angle=swiftshader',
];
const launch = (args: string[]) => ({
  executablePath: process.env.LUMENCUT_CHROMIUM ?? '/usr/bin/chromium',
  args,
});

/** Two browsers, without WebGPU and with a software GPU; tests of a file run in sequence without retries. */
export default defineConfig({
  testDir: 'e2e',
  ...(isLong ? { grep: LONG } : { grepInvert: LONG }),
  outputDir: 'test-results/files',
  // Pages mostly wait for timers: two of them keep two cores busy.
  workers: 2,
  retries: 0,
  fullyParallel: false,
  forbidOnly: true,
  // Generous, for busy machines; waits end as soon as possible.
  timeout: 300_000,
  globalTimeout: 1_800_000,
  expect: { timeout: 90_000 },
  reporter: 'list',
  use: {
    baseURL: `http://127.0.0.1:${port}/`,
    viewport: { width: 800, height: 560 },
    // As at 50 % zoom: the CPU renders a quarter of the pixels. Tests that compare with other pictures choose 1.
    deviceScaleFactor: 0.5,
    colorScheme: 'dark',
    actionTimeout: 90_000,
    navigationTimeout: 90_000,
  },
  webServer: docs
    ? []
    : {
        command: `npx vite preview --config e2e/served.config.ts --host 127.0.0.1 --port ${port} --strictPort`,
        url: `http://127.0.0.1:${port}/`,
        timeout: 20_000,
      },
  projects: [
    {
      name: 'cpu',
      testIgnore: docs ? 'gpu.spec.ts' : ['gpu.spec.ts', 'docs.spec.ts'],
      use: { launchOptions: launch(plain) },
    },
    {
      name: 'gpu',
      testMatch: ['gpu.spec.ts', 'native.spec.ts'],
      grepInvert: isLong ? CPU_ONLY : [CPU_ONLY, LONG],
      use: {
        launchOptions: launch([...plain, ...gpu]),
        viewport: { width: 480, height: 400 },
        deviceScaleFactor: 1,
      },
    },
  ],
});
