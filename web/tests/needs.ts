/** Says before the tests what some of them need and this checkout lacks; in CI nothing may be lacking. */
import { existsSync } from 'node:fs';

const NEEDS = [
  {
    file: new URL('../src/core/pkg/lumencut_bg.wasm', import.meta.url),
    lacking: 'tests of the engine fail without the WebAssembly module: run `npm run wasm`',
  },
  {
    file: new URL('../../.venv/bin/lumencut', import.meta.url),
    lacking: 'tests that compare with Python are left out without the package: run `make develop`',
  },
];

export function setup(): void {
  const lacking = NEEDS.filter(({ file }) => !existsSync(file)).map((need) => need.lacking);
  if (lacking.length > 0 && process.env.CI) {
    throw new Error(lacking.join('\n'));
  }
  for (const words of lacking) {
    console.warn(`\n${words}`);
  }
}
