/** A document stays the same when it is saved as a session and opened again. */
import { describe, expect, test } from 'vitest';
import type { Report } from '../src/core/messages';
import { STANDARD } from '../src/core/planes';
import { type Document, NO_MARKS } from '../src/state/document';
import { cameraOf, contentOf, type DisplayState, documentOf } from '../src/study/session-content';

const GRID = [
  [0.5, 0, 0, -10],
  [0, 0.5, 0, 20],
  [0, 0, 1, 30],
  [0, 0, 0, 1],
];
const REPORT: Report = {
  volume: {
    size: [10, 11, 12],
    world_from_index: GRID,
    corners: [],
    smallest_side: 0.5,
    pixel_side: 0.25,
    scan: '',
    doubt: null,
    notes: [],
  },
  vessels: [],
  windows: null,
};
const COLOR = '#1177aa';
const DOCUMENT: Document = {
  vessels: [
    {
      id: 0,
      line: 4,
      name: 'aorta',
      color: COLOR,
      isHidden: false,
      clicks: [
        [1, 2, 3],
        [4, 5, 6],
      ],
      doubt: null,
      contours: [],
    },
    { id: 1, line: 7, name: '', color: '#cc6600', isHidden: true, clicks: null, doubt: null, contours: [] },
    {
      id: 2,
      line: 9,
      name: '',
      color: '#cc6600',
      isHidden: false,
      clicks: null,
      doubt: 'it leaves sideways',
      contours: [],
    },
  ],
  stoppers: [{ center: [1, 1, 1], radius: 3 }],
  bridge: true,
  marks: { 1: { ...NO_MARKS, at: 12.5, references: [3, 40], method: 'area', stretch: [1, 9] } },
  rulers: [{ from: [0, 0, 0], to: [3, 4, 0] }],
  bone_hidden: false,
  dark: false,
  isOneMillimetre: false,
};
const LOOKED: DisplayState = {
  camera: {
    center: [0, 0, 0],
    direction: [0, 1, 0],
    up: [0, 0, 1],
    size: [640.4, 480.6],
    pixel_spacing: 0.5,
  },
  method: 'csr',
  settings: { window: [300, 900] },
  layout: 'strip',
  crossHair: [1, 2, 3],
  slices: STANDARD,
  compared: null,
  picked: { id: 1, at: 12.5 },
};

describe('the content of a session', () => {
  test('restores the document', () => {
    expect(documentOf(contentOf(DOCUMENT, REPORT, LOOKED))).toEqual(DOCUMENT);
  });

  test('states whether voxels of 1 mm are assumed; a file without this statement assumes nothing', () => {
    const assumed = { ...DOCUMENT, isOneMillimetre: true };
    const content = contentOf(assumed, REPORT, LOOKED);
    expect(documentOf(content)).toEqual(assumed);
    const { one_millimetre_assumed: _, ...silent } = content.session;
    expect(documentOf({ ...content, session: silent }).isOneMillimetre).toBe(false);
  });

  test('numbers vessels from 0, whatever their ids were', () => {
    const [first, second, third] = DOCUMENT.vessels;
    if (!first || !second || !third) {
      throw new Error('three vessels');
    }
    const vessels = [third, { ...second, id: 8 }, { ...first, id: 5 }];
    const odd = { ...DOCUMENT, vessels, marks: { 8: DOCUMENT.marks[1] ?? NO_MARKS } };
    const content = contentOf(odd, REPORT, { ...LOOKED, picked: { id: 5, at: 1 } });
    expect(content.session.view?.picked).toEqual({ vessel: 1, at_mm: 1 });
    expect(content.lines.map((line) => line.line)).toEqual([7, 4]);
    expect(content.doubtful_lines.map((line) => line.line)).toEqual([9]);
    const back = documentOf(content);
    expect(back.vessels.map(({ id, line }) => [id, line])).toEqual([
      [0, 7],
      [1, 4],
      [2, 9],
    ]);
    expect(back.marks[0]?.at).toBe(12.5);
  });

  test('has integer pixels, and no view if there is none', () => {
    expect(contentOf(DOCUMENT, REPORT, LOOKED).session.view?.camera.size).toEqual([640, 481]);
    expect(contentOf(DOCUMENT, REPORT, null).session.view).toBeNull();
  });

  test('contains the FWHM that the user entered', () => {
    expect(contentOf(DOCUMENT, REPORT, null, 0.9).session.fwhm_mm).toBe(0.9);
    expect(contentOf(DOCUMENT, REPORT, null).session.fwhm_mm).toBeNull();
  });

  test('contains nothing about files or the patient', () => {
    const keys = Object.keys(contentOf(DOCUMENT, REPORT, LOOKED).session);
    expect(keys).toEqual([
      'scan',
      'vessels',
      'doubtful',
      'stoppers',
      'bridge',
      'rulers',
      'fwhm_mm',
      'view',
      'one_millimetre_assumed',
      'bone_hidden',
      'dark',
    ]);
  });
});

test('a camera shows the same extent in a pane of another size', () => {
  const view = contentOf(DOCUMENT, REPORT, LOOKED).session.view;
  const camera = view && cameraOf(view, [1000, 962]);
  expect(camera?.pixel_spacing).toBeCloseTo((0.5 * 480.6) / 962, 11);
  expect(camera?.size).toEqual([1000, 962]);
  const again = view && cameraOf(view, LOOKED.camera.size);
  expect(again?.pixel_spacing).toBeCloseTo(0.5, 11);
});
