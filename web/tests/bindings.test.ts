import { describe, expect, test } from 'vitest';
import { actionOf, actionOfKey, BINDINGS, inputName, keyOf, type Where } from '../src/input/bindings';

const inputOf = (row: (typeof BINDINGS)[number], where: Where) =>
  [where, row.gesture, row.button ?? '', row.modifier ?? '', row.key ?? ''].join('|');

test('no two rows of the table have the same input', () => {
  const inputs = BINDINGS.flatMap((row) =>
    row.where === 'everywhere' ? [inputOf(row, 'turning'), inputOf(row, 'flat')] : [inputOf(row, row.where)],
  );
  expect(new Set(inputs).size).toBe(inputs.length);
});

test('the help lists each input once per part, and describes it', () => {
  for (const where of ['turning', 'flat', 'everywhere', 'tracing', 'marks'] as const) {
    const names = BINDINGS.filter((row) => row.where === where).map(inputName);
    expect(new Set(names).size).toBe(names.length);
    expect(names.every((name) => name.length > 0)).toBe(true);
  }
  expect(BINDINGS.every((row) => row.words.length > 2)).toBe(true);
});

describe('inputs are those usual in medical viewers', () => {
  test.each([
    ['turning', 'left', '', 'rotate'],
    ['turning', 'left', 'Alt', 'rotate about vessel'],
    ['turning', 'left', 'Ctrl', 'window'],
    ['turning', 'left', 'Shift', 'pan'],
    ['turning', 'middle', '', 'pan'],
    ['turning', 'right', '', 'window'],
    ['flat', 'left', '', 'pan'],
    ['flat', 'left', 'Shift', 'pan'],
    ['flat', 'middle', '', 'pan'],
    ['flat', 'right', '', 'window'],
  ] as const)('in %s views a drag with %s %s does: %s', (where, button, modifier, action) => {
    expect(actionOf(where, 'drag', button, modifier)).toBe(action);
  });

  test.each([
    ['turning', 'wheel', '', 'zoom'],
    ['turning', 'wheel', 'Ctrl', 'zoom'],
    ['flat', 'wheel', '', 'scroll'],
    ['flat', 'wheel', 'Ctrl', 'zoom'],
    ['turning', 'touch drag', '', 'rotate'],
    ['flat', 'touch drag', '', 'scroll'],
    ['turning', 'two-finger drag', '', 'pan'],
    ['flat', 'pinch', '', 'zoom'],
    ['turning', 'click', '', 'pick'],
    ['flat', 'double click', '', 'maximise'],
  ] as const)('in %s views %s %s does: %s', (where, gesture, modifier, action) => {
    expect(actionOf(where, gesture, null, modifier)).toBe(action);
  });

  test.each([
    ['click', null, 'set point'],
    ['double click', null, 'end vessel'],
    ['click', 'right', 'add point'],
  ] as const)('while tracing %s with %s does: %s', (gesture, button, action) => {
    expect(actionOf('tracing', gesture, button, '')).toBe(action);
  });

  test('while tracing, all other inputs act as in the view', () => {
    expect(actionOf('tracing', 'wheel', null, '')).toBeNull();
    expect(actionOf('tracing', 'drag', 'left', '')).toBeNull();
  });

  test('an input without a row does nothing', () => {
    expect(actionOf('turning', 'drag', 'right', 'Alt')).toBeNull();
    expect(actionOfKey('q')).toBeNull();
  });
});

describe('keys', () => {
  test.each([
    ['a', 'view anterior'],
    ['A', 'view anterior'],
    ['p', 'view posterior'],
    ['P', 'view posterior'],
    ['l', 'view left'],
    ['L', 'view left'],
    ['R', 'view right'],
    ['S', 'view superior'],
    ['I', 'view inferior'],
    ['r', 'reset'],
    ['i', 'invert'],
    ['c', 'context'],
    ['s', 'silhouettes'],
    [' ', 'turn'],
    ['?', 'help'],
    ['Escape', 'cancel'],
  ])('%s does: %s', (key, action) => {
    expect(actionOfKey(key)).toBe(action);
  });

  test.each([
    ['t', '', 'trace'],
    ['b', '', 'branches'],
    ['v', '', 'vessels'],
    ['Enter', '', 'enter'],
    ['Delete', '', 'remove'],
    ['Backspace', '', 'remove point'],
    ['z', 'Ctrl', 'undo'],
    ['Z', 'Ctrl', 'redo'],
    ['y', 'Ctrl', 'redo'],
    ['s', 'Ctrl', 'save session'],
    ['S', 'Ctrl', 'save report'],
    ['s', '', 'silhouettes'],
  ] as const)('%s with %j does: %s', (key, modifier, action) => {
    expect(actionOfKey(key, modifier)).toBe(action);
  });

  test.each([
    ['Z', false, 'undo'],
    ['z', true, 'redo'],
    ['z', false, 'undo'],
    ['Z', true, 'redo'],
  ])('%s with Ctrl, and Shift %j, does the same with Caps Lock: %s', (key, shiftKey, action) => {
    expect(actionOfKey(keyOf({ key, shiftKey }), 'Ctrl')).toBe(action);
  });

  test('that are no letters stay as they are', () => {
    for (const key of ['?', 'Enter', '1', ' ', '+']) {
      expect(keyOf({ key, shiftKey: true })).toBe(key);
    }
  });

  test('with Ctrl have no other action, so that shortcuts of the browser work', () => {
    expect(actionOfKey('z')).toBeNull();
    for (const key of ['a', 'p', 'r', 't', 'c', '1', ' ', 'Enter']) {
      expect(actionOfKey(key, 'Ctrl')).toBeNull();
    }
  });

  test('1 to 9 choose the named windows in their order', () => {
    const keys = BINDINGS.filter((row) => row.action.startsWith('preset '));
    expect(keys).toHaveLength(9);
    keys.forEach((row, n) => {
      expect(row).toMatchObject({ key: String(n + 1), action: `preset ${n}` });
      expect(actionOfKey(String(n + 1))).toBe(`preset ${n}`);
    });
  });

  test('the help writes capitals with Shift, and the space key as a word', () => {
    const nameOf = (key: string) => BINDINGS.filter((row) => row.key === key).map(inputName);
    expect(nameOf('R')).toEqual(['Shift+r']);
    expect(nameOf(' ')).toEqual(['Space']);
    expect(nameOf('Escape')).toEqual(['Escape']);
    expect(nameOf('z')).toEqual(['Ctrl+z']);
    expect(nameOf('Z')).toEqual(['Ctrl+Shift+z']);
  });
});
