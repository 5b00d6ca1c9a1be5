/** Converts document and view to the content of a session file, and back. */
import { gridOf } from '../core/linked';
import type {
  Camera,
  DocumentVessel,
  Pair,
  Report,
  SavedComparison,
  SavedMarks,
  SavedView,
  SessionContent,
  Settings,
  Slices,
  StenosisMethod,
  Territory,
  Vector,
} from '../core/messages';
import { STANDARD } from '../core/planes';
import type { Document, VesselMarks } from '../state/document';

export interface DisplayState {
  readonly camera: Camera;
  readonly method: string;
  readonly settings: Settings;
  readonly layout: string;
  readonly crossHair: Vector | null;
  readonly slices: Slices;
  readonly compared: SavedComparison | null;
  /** The picked vessel, and the arc length of the section on it (mm). */
  readonly picked: { readonly id: number; readonly at: number } | null;
}

/** Content of a session file; `fwhm` is the FWHM entered by the user (mm). */
export function contentOf(
  document: Document,
  report: Report,
  displayState: DisplayState | null,
  fwhm: number | null = null,
): SessionContent {
  const isSure = (vessel: DocumentVessel) => vessel.doubt === null;
  const sure = document.vessels.filter(isSure);
  const doubtful = document.vessels.filter((vessel) => !isSure(vessel));
  const lineOf = ({ line, name }: DocumentVessel) => ({ line, name });
  return {
    lines: sure.map(lineOf),
    doubtful_lines: doubtful.map(lineOf),
    session: {
      scan: report.volume && gridOf(report.volume),
      vessels: sure.map(({ id, color, isHidden, clicks, contours }) => ({
        color,
        hidden: isHidden,
        clicks,
        marks: savedMarks(document.marks[id]),
        ...(contours.length > 0 && { contours_mm: contours }),
      })),
      doubtful: doubtful.map(({ color, doubt }) => ({ color, doubt: doubt ?? '' })),
      stoppers: document.stoppers.map(({ center, radius }) => ({ center, radius_mm: radius })),
      bridge: document.bridge,
      rulers: document.rulers,
      fwhm_mm: fwhm,
      view: displayState && viewOf(displayState, sure),
      one_millimetre_assumed: document.isOneMillimetre,
      bone_hidden: document.bone_hidden,
      dark: document.dark,
      ...(displayState?.compared && { compared: displayState.compared }),
    },
  };
}

function viewOf(displayState: DisplayState, vessels: readonly DocumentVessel[]): SavedView {
  const { camera, method, settings, layout, crossHair, slices, picked } = displayState;
  const { center, direction, up } = camera;
  const number = picked ? vessels.findIndex((vessel) => vessel.id === picked.id) : -1;
  return {
    camera: { center, direction, up, ...pixelsOf(camera) },
    method,
    settings,
    layout,
    cross_hair: crossHair,
    ...(slices !== STANDARD && { slices }),
    picked: picked && number >= 0 ? { vessel: number, at_mm: picked.at } : null,
  };
}

/** Digits of numbers in the file; rounding errors from changes of the pane size disappear. */
const DIGITS = 12;

/** Rounds the view size to integer pixels; the shorter side keeps its extent in mm. */
function pixelsOf({ size, pixel_spacing }: Camera): Pick<Camera, 'size' | 'pixel_spacing'> {
  const whole: Pair = [Math.round(size[0]), Math.round(size[1])];
  const spacing = (pixel_spacing * Math.min(...size)) / Math.min(...whole);
  return { size: whole, pixel_spacing: Number(spacing.toPrecision(DIGITS)) };
}

function savedMarks(marks: VesselMarks | undefined): SavedMarks | null {
  return marks
    ? {
        at_mm: marks.at,
        references_mm: marks.references,
        method: marks.method,
        original_mm: marks.original,
        comparison_mm: marks.comparison,
        group: marks.group,
        stretch_mm: marks.stretch,
        second_stretch_mm: marks.secondStretch,
        ...(marks.diameters.length > 0 && { diameters_mm: marks.diameters }),
        ...(marks.confirmed.length > 0 && { confirmed_mm: marks.confirmed }),
      }
    : null;
}

/** Restores the document of a session; the ids of its vessels count from 0. */
export function documentOf({ lines, doubtful_lines, session }: SessionContent): Document {
  const sure = session.vessels.map((vessel, id): DocumentVessel => {
    const { line, name } = lines[id] ?? { line: -1, name: '' };
    return {
      id,
      line,
      name,
      color: vessel.color,
      isHidden: vessel.hidden,
      clicks: vessel.clicks,
      doubt: null,
      contours: vessel.contours_mm ?? [],
    };
  });
  const doubtful = session.doubtful.map(({ color, doubt }, number): DocumentVessel => {
    const { line, name } = doubtful_lines[number] ?? { line: -1, name: '' };
    const more = { isHidden: false, clicks: null, contours: [] };
    return { id: sure.length + number, line, name, color, doubt, ...more };
  });
  const marks = session.vessels.flatMap((vessel, id) => (vessel.marks ? [[id, marksOf(vessel.marks)]] : []));
  return {
    vessels: [...sure, ...doubtful],
    stoppers: session.stoppers.map(({ center, radius_mm }) => ({ center, radius: radius_mm })),
    bridge: session.bridge,
    marks: Object.fromEntries(marks) as Document['marks'],
    rulers: session.rulers,
    isOneMillimetre: session.one_millimetre_assumed ?? false,
    bone_hidden: session.bone_hidden ?? false,
    dark: session.dark ?? false,
  };
}

function marksOf(saved: SavedMarks): VesselMarks {
  return {
    at: saved.at_mm,
    references: saved.references_mm,
    method: saved.method as StenosisMethod,
    original: saved.original_mm,
    comparison: saved.comparison_mm,
    group: saved.group as Territory | null,
    stretch: saved.stretch_mm,
    secondStretch: saved.second_stretch_mm,
    diameters: saved.diameters_mm ?? [],
    confirmed: saved.confirmed_mm ?? [],
  };
}

/** The saved camera for another pane size; the shorter side keeps its extent in mm. */
export function cameraOf({ camera }: SavedView, size: Pair): Camera {
  const scale = Math.min(...camera.size) / Math.min(...size);
  return { ...camera, size, pixel_spacing: camera.pixel_spacing * scale };
}
