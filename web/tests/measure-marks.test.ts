/** Places that the user marks, and places that Lumencut suggests. */
import { describe, expect, test } from 'vitest';
import type { Pair, Vector } from '../src/core/messages';
import {
  allConfirmed,
  comparedIn,
  marksOf,
  moved,
  placeAfter,
  placesOf,
  referenceSlots,
  removed,
  stretchAround,
  type VesselPlace,
  withDiameter,
  withMarks,
  withReference,
  withStretch,
} from '../src/measure/marks';
import { centerAt, seenNearest, snapped } from '../src/measure/sections';
import { placeName } from '../src/measure/words';
import { EMPTY } from '../src/state/document';
import { NOTHING_SUGGESTED, type Suggested } from '../src/state/measuring';
import { madeProfile, marks } from './measured';

const profile = madeProfile();
const SUGGESTED: Suggested = [
  { at: 15, diameter: 8 },
  { at: 45, diameter: 8 },
];
const found = (given: ReturnType<typeof marks>, suggested = SUGGESTED) => placesOf(profile, given, suggested);
const short = (places: readonly VesselPlace[]) =>
  places.map(({ kind, slot, at, isSuggestion }) => `${kind} ${slot} ${at}${isSuggestion ? '?' : ''}`);
function place(given: ReturnType<typeof marks>, kind: string, slot = 0): VesselPlace {
  const one = found(given).find((each) => each.kind === kind && each.slot === slot);
  if (!one) {
    throw new Error(`no ${kind} ${slot}`);
  }
  return one;
}

describe('noted diameters', () => {
  const given = marks({ diameters: [12, 50] });
  const diameters = found(given).filter(({ kind }) => kind === 'diameter');

  test('are separate places, which do not affect the percentage', () => {
    expect(short(diameters)).toEqual(['diameter 0 12', 'diameter 1 50']);
    expect(comparedIn(diameters)).toBeNull();
    expect(diameters.map(placeName)).toEqual(['noted diameter', 'noted diameter']);
  });

  test('are moved and removed one by one, and no place is noted twice', () => {
    const second = place(given, 'diameter', 1);
    const after = moved(profile, given, second, 40);
    expect(after).toEqual(marks({ diameters: [12, 40] }));
    expect(placeAfter(profile, given, second, after).at).toBe(40);
    expect(removed(given, place(given, 'diameter'))).toEqual(marks({ diameters: [50] }));
    expect(withDiameter(given, 50)).toBe(given);
    expect(withDiameter(given, 3)).toEqual(marks({ diameters: [12, 50, 3] }));
  });
});

describe('places', () => {
  test('a reference is shown even if no narrowest place is known', () => {
    const alone = placesOf({ ...profile, narrowest: null }, marks({ references: [40] }), NOTHING_SUGGESTED);
    expect(short(alone)).toEqual(['reference 0 40']);
  });

  test('all places are suggestions while nothing is marked', () => {
    expect(short(found(marks({})))).toEqual(['place 0 30?', 'reference 0 15?', 'reference 1 45?']);
  });

  test('a vessel without valid sections has no places', () => {
    expect(placesOf({ ...profile, narrowest: null }, marks({}), NOTHING_SUGGESTED)).toEqual([]);
  });

  test('if one reference is marked, the one on the other side of the stenosis is still suggested', () => {
    expect(short(found(marks({ at: 30, references: [40] }), [{ at: 15, diameter: 8 }, null]))).toEqual([
      'place 0 30',
      'reference 0 15?',
      'reference 1 40',
    ]);
    expect(referenceSlots(marks({ references: [12] }), 30)).toEqual([12, null]);
    expect(referenceSlots(marks({ references: [50, 40] }), 30)).toEqual([40, 50]);
  });

  test('two references on one side are both named after that side', () => {
    const names = (references: number[]) =>
      found(marks({ at: 30, references }))
        .filter(({ kind }) => kind === 'reference')
        .map(placeName);
    expect(names([35, 50])).toEqual(['reference after', 'reference after']);
    expect(names([10, 50])).toEqual(['reference before', 'reference after']);
  });

  test('with two marked references, no reference is suggested', () => {
    expect(short(found(marks({ at: 30, references: [10, 50] })))).toEqual([
      'place 0 30',
      'reference 0 10',
      'reference 1 50',
    ]);
  });
});

test('the stenosis is compared with its references, whether marked or suggested', () => {
  const compared = comparedIn(found(marks({ references: [40], stretch: [1, 5] })));
  expect(compared?.at).toBe(30);
  expect(compared?.references.map(({ at }) => at)).toEqual([15, 40]);
  expect(comparedIn([])).toBeNull();
});

describe('moving', () => {
  test('only a suggestion that is moved becomes a mark', () => {
    const given = marks({});
    const after = moved(profile, given, place(given, 'reference', 1), 42);
    expect(after).toEqual(marks({ references: [42] }));
    expect(moved(profile, given, place(given, 'place'), 28)).toEqual(marks({ at: 28 }));
  });

  test('two references stay on their sides and in order', () => {
    const given = marks({ at: 30, references: [15, 45] });
    expect(moved(profile, given, place(given, 'reference', 0), 50).references).toEqual([30, 45]);
    expect(moved(profile, given, place(given, 'reference', 1), 3).references).toEqual([15, 30]);
    expect(moved(profile, given, place(given, 'reference', 1), 1000).references).toEqual([15, 60]);
  });

  test('a single reference may pass the stenosis, and then belongs to the other side', () => {
    for (const given of [marks({}), marks({ references: [45] }), marks({ at: 30, references: [45] })]) {
      const one = place(given, 'reference', 1);
      for (const [to, slot] of [
        [30.5, 1],
        [30, 1],
        [29.5, 0],
        [12, 0],
        [33, 1],
      ] as const) {
        const after = moved(profile, given, one, to);
        expect(after).toEqual({ ...given, references: [to] });
        expect(placeAfter(profile, given, one, after)).toMatchObject({ slot, at: to, isSuggestion: false });
      }
    }
  });

  test('a reference exactly at the stenosis cannot pass the other reference', () => {
    const given = marks({ at: 30, references: [15, 30] });
    const one = place(given, 'reference', 1);
    const after = moved(profile, given, one, 20);
    expect(after.references).toEqual([15, 30]);
    expect(placeAfter(profile, given, one, after)).toMatchObject({ slot: 1, at: 30 });
  });

  test('the stenosis may pass its references', () => {
    const given = marks({ at: 30, references: [15, 45] });
    const main = place(given, 'place');
    for (const to of [5, 15, 45, 55]) {
      const after = moved(profile, given, main, to);
      expect(after).toEqual({ ...given, at: to });
      expect(placeAfter(profile, given, main, after)).toMatchObject({ kind: 'place', slot: 0, at: to });
    }
    expect(moved(profile, marks({}), place(marks({}), 'place'), -4).at).toBe(0);
  });

  test('a reference that the stenosis has passed belongs to the other side', () => {
    const given = marks({ at: 30, references: [45] });
    const after = moved(profile, given, place(given, 'place'), 50);
    expect(short(found(after, NOTHING_SUGGESTED))).toEqual(['place 0 50', 'reference 0 45']);
  });

  test('two references from a file can both be moved if they lie on one side', () => {
    const given = marks({ at: 10, references: [20, 40] });
    expect(moved(profile, given, place(given, 'reference', 0), 25).references).toEqual([25, 40]);
  });

  test('the ends of a stretch keep their order', () => {
    const given = marks({ at: 30, stretch: [20, 40] });
    expect(moved(profile, given, place(given, 'stretch', 0), 55).stretch).toEqual([39, 40]);
    expect(moved(profile, given, place(given, 'stretch', 1), 2).stretch).toEqual([20, 21]);
  });
});

describe('confirming and removing', () => {
  test('all suggestions are confirmed at once', () => {
    const after = allConfirmed(profile, marks({}), SUGGESTED);
    expect(after).toEqual(marks({ at: 30, references: [15, 45], confirmed: [30, 15, 45] }));
  });

  test('a confirmed suggestion is named so until it is moved', () => {
    const after = allConfirmed(profile, marks({}), SUGGESTED);
    expect(found(after).map(placeName)).toEqual([
      'narrowest place (confirmed suggestion)',
      'reference before (confirmed suggestion)',
      'reference after (confirmed suggestion)',
    ]);
    const elsewhere = moved(profile, after, place(after, 'place'), 28);
    expect(placeName(place(elsewhere, 'place'))).toBe('marked place');
  });

  test('a confirmed place stays where it was shown, even if both references lie on one side', () => {
    for (const references of [[10, 20], [35, 50], [20], [40]]) {
      const given = marks({ references });
      const dashed = found(given).filter(({ isSuggestion }) => isSuggestion);
      expect(dashed.length).toBeGreaterThan(0);
      const after = allConfirmed(profile, given, SUGGESTED);
      expect(after.at).toBe(30);
      const offered = dashed.filter(({ kind }) => kind === 'reference').map(({ at }) => at);
      expect(after.references).toEqual([...references, ...offered].sort((a, b) => a - b));
    }
  });

  test('a removed mark is suggested again; a suggestion cannot be removed', () => {
    const given = marks({ at: 30, references: [15, 45] });
    expect(removed(given, place(given, 'reference', 0)).references).toEqual([45]);
    expect(removed(given, place(given, 'place')).at).toBeNull();
    expect(removed(marks({}), place(marks({}), 'place'))).toEqual(marks({}));
  });

  test('if the first stretch is removed, the second one becomes the first', () => {
    const given = marks({ stretch: [1, 5], secondStretch: [9, 20] });
    expect(removed(given, place(given, 'stretch', 1))).toEqual(marks({ stretch: [9, 20] }));
    expect(removed(given, place(given, 'secondStretch'))).toEqual(marks({ stretch: [1, 5] }));
  });

  test('a stretch lies within the vessel', () => {
    expect(stretchAround(profile, 30)).toEqual([22.5, 37.5]);
    expect(stretchAround(profile, 1)).toEqual([0, 15]);
    expect(stretchAround(profile, 60)).toEqual([45, 60]);
  });
});

describe('sections', () => {
  test('the nearest section is found; of two equally near, the first', () => {
    expect(snapped(profile, 12.3)).toBe(12.5);
    expect(snapped(profile, 12.25)).toBe(12);
    expect(snapped(profile, 99)).toBe(60);
  });

  test('a centre between two sections is interpolated', () => {
    expect(centerAt(profile, 12.2)).toEqual([0, 0, 12.2]);
    expect(centerAt(profile, 0)).toEqual([0, 0, 0]);
    expect(centerAt(profile, 70)).toEqual([0, 0, 60]);
  });

  test('the section seen nearest to the pointer is found', () => {
    const seen = ([, , z]: Vector): Pair => [10, 4 * z];
    expect(seenNearest(profile, seen, [17, 81], 5)).toBe(20);
  });

  test('if the vessel crosses itself in the view, the place stays on its side of the loop', () => {
    // The view direction is such that the places at 20 mm and 40 mm lie on the same pixel.
    const seen = ([, , z]: Vector): Pair => [200 - 10 * Math.abs(z - 30), 0];
    expect(seenNearest(profile, seen, [100, 2], 23)).toBe(20);
    expect(seenNearest(profile, seen, [100, 2], 37)).toBe(40);
  });
});

describe('the document', () => {
  const vessel = (id: number, line: number) => ({
    id,
    line,
    name: '',
    color: '#ffffff',
    isHidden: false,
    clicks: null,
    doubt: null,
    contours: [],
  });
  const before = { ...EMPTY, vessels: [vessel(4, 9), vessel(5, 7)] };

  test('keeps marks by vessel ids, which stay the same when lines change', () => {
    const after = withMarks(before, 9, marks({ at: 3 }));
    expect(after.marks).toEqual({ 4: marks({ at: 3 }) });
    expect(marksOf(after, 9).at).toBe(3);
    expect(marksOf(after, 7)).toEqual(marks({}));
    const edited = { ...after, vessels: [vessel(4, 12), vessel(5, 7)] };
    expect(marksOf(edited, 12).at).toBe(3);
  });

  test('stays the same if no vessel has the line', () => {
    expect(withMarks(before, 12345, marks({ at: 5 }))).toBe(before);
  });
});

describe('marks at the section', () => {
  test('a new reference replaces one on its side of the stenosis, but not one on the other side', () => {
    const both = marks({ at: 30, references: [15, 45] });
    expect(withReference(profile, marks({ at: 30, references: [15] }), 45).references).toEqual([15, 45]);
    expect(withReference(profile, marks({ at: 30, references: [15] }), 15).references).toEqual([15]);
    expect(withReference(profile, marks({ at: 30, references: [15] }), 20).references).toEqual([20]);
    expect(withReference(profile, both, 50).references).toEqual([15, 50]);
    expect(withReference(profile, both, 10).references).toEqual([10, 45]);
  });

  test('a stretch lies between two places in any order, is at least 1 mm long, and lies within the vessel', () => {
    expect(withStretch(profile, marks({}), 40, 12).stretch).toEqual([12, 40]);
    expect(withStretch(profile, marks({}), 20, 20).stretch).toEqual([20, 21]);
    const length = profile.arc_length.at(-1) ?? 0;
    expect(withStretch(profile, marks({}), length, length).stretch).toEqual([length - 1, length]);
  });

  test('a second stretch does not change the first one', () => {
    const after = withStretch(profile, marks({ stretch: [5, 9] }), 12, 40);
    expect([after.stretch, after.secondStretch]).toEqual([
      [5, 9],
      [12, 40],
    ]);
  });
});
