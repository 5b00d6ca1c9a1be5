/** Bundles the gestures of the page for the notebook: `front/pointers.js` of the Python package. With --check only compares. */
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';

const ENTRY = fileURLToPath(new URL('../src/notebook/pointers.ts', import.meta.url));
const BUNDLE = fileURLToPath(new URL('../../python/lumencut/notebook/front/pointers.js', import.meta.url));
const HEAD =
  '// Gestures of the page on a picture, as steps for the kernel; `npm run notebook` writes it from web/src/notebook.\n';

/** A script that defines `gestures`; the package joins it with other scripts to one module. */
async function bundled() {
  const [{ output }] = await build({
    configFile: false,
    logLevel: 'warn',
    build: {
      write: false,
      minify: false,
      target: 'es2022',
      lib: { entry: ENTRY, formats: ['iife'], name: 'gestures' },
    },
  });
  return HEAD + output[0].code;
}

const expected = await bundled();
if (!process.argv.includes('--check')) {
  writeFileSync(BUNDLE, expected);
} else if (readFileSync(BUNDLE, 'utf-8') !== expected) {
  process.exitCode = 1;
  console.error(
    `${BUNDLE}: found another text; expected the bundle of web/src/notebook; run npm run notebook`,
  );
}
