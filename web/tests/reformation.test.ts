/** Tests of the requests for reformations, and of the captions of their pictures. */
import { expect, test } from 'vitest';
import { wrapped } from '../src/output/wrapping';
import { type Chosen, REFORMATIONS, reformationOf } from '../src/state/reformation';

const CHOSEN: Chosen = {
  vessel: 2,
  side: { direction: [0, 1, 0], up: [0, 0, 1] },
  angle: 0.3,
  amount: 0.25,
  of: 'radius',
  at: 12.5,
  lens: 'fisheye',
  backwards: true,
};

test('the request of each reformation contains only what it needs', () => {
  const { side } = CHOSEN;
  expect(reformationOf('untangled', CHOSEN)).toEqual({ kind: 'untangled', side });
  expect(reformationOf('network', CHOSEN)).toEqual({ kind: 'network', side });
  expect(reformationOf('uncurl', CHOSEN)).toEqual({ kind: 'uncurl', vessel: 2, side, amount: 0.25 });
  expect(reformationOf('spiral', CHOSEN)).toEqual({ kind: 'spiral', vessel: 2, angle: 0.3 });
  expect(reformationOf('map', CHOSEN)).toEqual({ kind: 'map', vessel: 2, of: 'radius' });
  const eye = { at: 12.5, lens: 'fisheye', backwards: true };
  expect(reformationOf('endoscopy', CHOSEN)).toEqual({ kind: 'endoscopy', vessel: 2, ...eye });
});

test('none is requested before there is a vessel, or a view if it needs one', () => {
  for (const [kind] of REFORMATIONS) {
    if (kind !== 'cpr') {
      expect(reformationOf(kind, { ...CHOSEN, vessel: null })).toBeNull();
      const needsView = ['untangled', 'network', 'uncurl'].includes(kind);
      expect(reformationOf(kind, { ...CHOSEN, side: null }) === null).toBe(needsView);
    }
  }
});

test('text is broken between words if a line is full, and no word is lost', () => {
  const lines = wrapped('Down: along the vessel, in mm.', 12, (text) => text.length);
  expect(lines).toEqual(['Down: along', 'the vessel,', 'in mm.']);
  expect(wrapped('incomprehensible word', 5, (text) => text.length)).toEqual(['incomprehensible', 'word']);
  expect(wrapped('', 5, (text) => text.length)).toEqual([]);
});
