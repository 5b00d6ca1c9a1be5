// Compares the gzipped size of the built page with budget.json. A pattern without a file is an error.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const web = dirname(dirname(fileURLToPath(import.meta.url)));
const built = readdirSync(join(web, 'dist'), { recursive: true, encoding: 'utf8' });
const budget = JSON.parse(readFileSync(join(web, 'budget.json'), 'utf8'));
let isRed = false;

/** Built files whose names match a pattern, in which `*` stands for any characters. */
function matching(pattern) {
  const [before, after] = pattern.split('*');
  return built.filter((name) => name.startsWith(before) && name.endsWith(after ?? ''));
}

for (const [name, { files, gzipped }] of Object.entries(budget)) {
  let bytes = 0;
  for (const pattern of files) {
    const found = matching(pattern);
    if (found.length === 0) {
      console.error(`size: no file is like ${pattern}`);
      isRed = true;
    }
    for (const file of found) {
      bytes += gzipSync(readFileSync(join(web, 'dist', file)), { level: 9 }).length;
    }
  }
  console.log(`${name}: ${bytes} of at most ${gzipped} bytes, gzipped`);
  isRed ||= bytes > gzipped;
}
process.exit(isRed ? 1 : 0);
