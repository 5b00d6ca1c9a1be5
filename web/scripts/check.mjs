// Runs the unit and browser tests of the built page. The last line is `N passed, N failed`.
// The exit status is not 0 if a test failed, a part did not finish, or no test ran.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { stripVTControlCharacters } from 'node:util';

const web = dirname(dirname(fileURLToPath(import.meta.url)));

/** Runs a test program. Returns its exit status, and its JSON report or null. */
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

/** Adds the results of a test program. If it failed without a failed test, or ran no test, this counts as a failure. */
function counted(name, { status, report }, passed, failed, red) {
  const count = report ? { passed: passed(report), failed: failed(report) } : { passed: 0, failed: 0 };
  if (count.failed === 0 && (status !== 0 || count.passed === 0)) {
    console.error(`${name}: exit status ${status}, ${count.passed} tests passed`);
    count.failed = 1;
  }
  return { ...count, red: report ? red(report) : [] };
}

/** Failed tests of Vitest, one line each. */
const redOfLogic = (report) =>
  report.testResults.flatMap(({ name, assertionResults }) =>
    assertionResults
      .filter(({ status }) => status === 'failed')
      .map(({ fullName, failureMessages }) => line(relative(web, name), fullName, failureMessages[0])),
  );

/** Failed tests of a Playwright suite, one line each. */
const redOfBrowser = ({ suites = [], specs = [] }) => [
  ...suites.flatMap(redOfBrowser),
  ...specs
    .filter(({ ok }) => !ok)
    .map(({ file, title, tests }) => line(`e2e/${file}`, title, tests[0]?.results[0]?.error?.message)),
];

/** A failed test, in the format of pytest, so that logs can be searched in the same way. */
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
