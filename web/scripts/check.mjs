// Runs the tests of the page: those of its logic, and those in a browser, which needs the built page (`npm run build`).
//
// The last line is `N passed, N failed`. The exit status is not 0 where a test failed, where a part did not run to its
// end, and where no test ran.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { stripVTControlCharacters } from 'node:util';

const web = dirname(dirname(fileURLToPath(import.meta.url)));

/** Runs one of the test programs; its report in JSON, or nothing where it wrote none. */
function run(program, programArguments, environment, report) {
  const command = join(web, 'node_modules/.bin', program);
  const done = spawnSync(command, programArguments, {
    cwd: web,
    env: { ...process.env, ...environment },
    stdio: 'inherit',
  });
  if (!existsSync(report)) {
    console.error(`${program}: found no report; ${done.error?.message ?? `exit status ${done.status}`}`);
    return { status: 1, report: null };
  }
  return { status: done.status ?? 1, report: JSON.parse(readFileSync(report, 'utf-8')) };
}

/** What a part counted; one that ended red without a red test, or ran no test, counts as a test that failed. */
function counted(name, { status, report }, passed, failed, red) {
  const count = report ? { passed: passed(report), failed: failed(report) } : { passed: 0, failed: 0 };
  if (count.failed === 0 && (status !== 0 || count.passed === 0)) {
    console.error(`${name}: exit status ${status}, ${count.passed} tests passed`);
    count.failed = 1;
  }
  return { ...count, red: report ? red(report) : [] };
}

/** The red tests of Vitest, a line each. */
const redOfLogic = (report) =>
  report.testResults.flatMap(({ name, assertionResults }) =>
    assertionResults
      .filter(({ status }) => status === 'failed')
      .map(({ fullName, failureMessages }) => line(relative(web, name), fullName, failureMessages[0])),
  );

/** The red tests of Playwright within a suite and those in it, a line each. */
const redOfBrowser = ({ suites = [], specs = [] }) => [
  ...suites.flatMap(redOfBrowser),
  ...specs
    .filter(({ ok }) => !ok)
    .map(({ file, title, tests }) => line(`e2e/${file}`, title, tests[0]?.results[0]?.error?.message)),
];

/** A line that begins as pytest's does, so that a log is searched for one word. */
const line = (file, title, message = 'no message') =>
  `FAILED web/${file} > ${title} - ${stripVTControlCharacters(message).split('\n')[0]}`;

const folder = mkdtempSync(join(tmpdir(), 'lumencut-web-'));
const [logic, browser] = [join(folder, 'logic.json'), join(folder, 'browser.json')];
const counts = [
  counted(
    'vitest',
    run('vitest', ['run', '--reporter=default', '--reporter=json', `--outputFile.json=${logic}`], {}, logic),
    (report) => report.numPassedTests,
    (report) => Math.max(report.numFailedTests, report.numFailedTestSuites > 0 ? 1 : 0),
    redOfLogic,
  ),
  counted(
    'playwright',
    run('playwright', ['test', '--reporter=list,json'], { PLAYWRIGHT_JSON_OUTPUT_NAME: browser }, browser),
    (report) => report.stats.expected,
    (report) => report.stats.unexpected + report.stats.flaky + report.errors.length,
    redOfBrowser,
  ),
];
rmSync(folder, { recursive: true, force: true });
const sum = (name) => counts.reduce((all, count) => all + count[name], 0);
for (const one of counts.flatMap(({ red }) => red)) {
  console.log(one);
}
console.log(`${sum('passed')} passed, ${sum('failed')} failed`);
process.exit(sum('failed') > 0 ? 1 : 0);
