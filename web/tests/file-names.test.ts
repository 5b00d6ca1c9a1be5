import { expect, test } from 'vitest';
import { fileName, sideOf } from '../src/output/file-names';

const NOW = new Date(2026, 1, 3, 9, 5);

test('a name consists of the scan without its extension, content, side and time', () => {
  const named = { scan: 'thorax 7.nii.gz', content: 'picture', side: 'anterior', ending: 'png' };
  expect(fileName(named, NOW)).toBe('thorax-7-picture-anterior-2026-02-03-0905.png');
});

test('a file that must not identify its scan has a name too', () => {
  const named = { scan: null, content: 'report', ending: 'html' };
  expect(fileName(named, NOW)).toBe('lumencut-report-2026-02-03-0905.html');
  expect(fileName({ ...named, scan: '../?*' }, NOW)).toBe(fileName(named, NOW));
});

test('a scan name never leads to another folder and is not too long for a file system', () => {
  const name = fileName(
    { scan: `../a/b:c\\${'x'.repeat(300)}`, content: 'session', ending: 'mrk.json' },
    NOW,
  );
  expect(name).toMatch(/^a-b-c-x+-session-2026-02-03-0905\.mrk\.json$/);
  expect(name.length).toBeLessThan(120);
  expect(fileName({ scan: 'Größe 影像', content: 'picture', ending: 'png' }, NOW)).toContain(
    'Größe-影像-picture',
  );
});

test('the side of a view is that of the camera; two sides are named if it is more than 22.5 degrees off', () => {
  expect(sideOf([0, 1, 0])).toBe('anterior');
  expect(sideOf([0, -2, 0])).toBe('posterior');
  expect(sideOf([-1, 0, 0])).toBe('left');
  expect(sideOf([1, 0, 0])).toBe('right');
  expect(sideOf([0, 0, -1])).toBe('superior');
  expect(sideOf([0, 0, 1])).toBe('inferior');
  const turned = (degrees: number) =>
    sideOf([-Math.sin((degrees * Math.PI) / 180), Math.cos((degrees * Math.PI) / 180), 0]);
  expect([turned(22), turned(23), turned(67), turned(68)]).toEqual([
    'anterior',
    'anterior-left',
    'left-anterior',
    'left',
  ]);
});
