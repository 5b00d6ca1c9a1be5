/** A reader answers the questions of a study, opened from a file, and saves the answers for the command line. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { expect, test } from '@playwright/test';

const ROOT = join(import.meta.dirname, '../..');
const python = process.env.LUMENCUT_PYTHON ?? join(ROOT, '.venv/bin/python');
const QUESTIONS = 21;

test('a reader answers 21 questions, and the command line compares the saved answers', async ({ page }) => {
  const folder = mkdtempSync(join(tmpdir(), 'lumencut-reading-study-'));
  const made = spawnSync(python, [join(ROOT, 'tests/reading_study_scene.py'), folder], { encoding: 'utf-8' });
  expect(made.status, made.stderr).toBe(0);
  const complaints: string[] = [];
  page.on('console', (message) => complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.goto(pathToFileURL(join(folder, 'reading-study.html')).href);
  await page.getByLabel('Your number as a reader').fill('2');
  await page.getByRole('button', { name: 'Begin' }).click();
  for (let answered = 0; answered < QUESTIONS; answered++) {
    await expect(page.locator('#progress')).toHaveText(`Question ${answered + 1} of ${QUESTIONS}`);
    await expect(
      page
        .locator('#pictures img')
        .or(page.getByRole('button', { name: 'Undecided' }))
        .first(),
    ).toBeVisible();
    await page.locator('#choices').getByRole('button').first().click();
    if (answered < QUESTIONS - 1) {
      await page.getByRole('button', { name: 'Next question' }).click();
    }
  }
  const waiting = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save answers' }).click();
  const download = await waiting;
  expect(download.suggestedFilename()).toBe('answers-02.json');
  const file = (await download.path()) ?? '';
  const { reader, answers } = JSON.parse(readFileSync(file, 'utf-8'));
  expect([reader, answers.length]).toEqual([2, QUESTIONS]);
  const words = ['-m', 'lumencut', 'reading-results', join(folder, 'key.json'), file];
  const compared = spawnSync(python, words, { cwd: ROOT, encoding: 'utf-8' });
  expect(compared.status, compared.stderr).toBe(0);
  expect(compared.stdout).toContain('1 of 2 readers.');
  expect(complaints).toEqual([]);
});
