/** Tables of the facade, written from crates/lumencut by `make generate`. */

/** Names of vessels that have a code in reports. */
export const VESSEL_NAMES = [
  "Aorta",
  "Ascending aorta",
  "Aortic arch",
  "Descending thoracic aorta",
  "Abdominal aorta",
  "Left main coronary artery",
  "Left anterior descending artery",
  "Circumflex artery",
  "Right coronary artery",
  "Pulmonary trunk",
  "Left pulmonary artery",
  "Right pulmonary artery",
  "Brachiocephalic trunk",
  "Left common carotid artery",
  "Right common carotid artery",
  "Left internal carotid artery",
  "Right internal carotid artery",
  "Left external carotid artery",
  "Right external carotid artery",
  "Left vertebral artery",
  "Right vertebral artery",
  "Basilar artery",
  "Left anterior cerebral artery",
  "Right anterior cerebral artery",
  "Left middle cerebral artery",
  "Right middle cerebral artery",
  "Left posterior cerebral artery",
  "Right posterior cerebral artery",
  "Left subclavian artery",
  "Right subclavian artery",
  "Left axillary artery",
  "Right axillary artery",
  "Celiac trunk",
  "Common hepatic artery",
  "Splenic artery",
  "Left gastric artery",
  "Superior mesenteric artery",
  "Inferior mesenteric artery",
  "Left renal artery",
  "Right renal artery",
  "Left common iliac artery",
  "Right common iliac artery",
  "Left internal iliac artery",
  "Right internal iliac artery",
  "Left external iliac artery",
  "Right external iliac artery",
  "Left common femoral artery",
  "Right common femoral artery",
  "Left superficial femoral artery",
  "Right superficial femoral artery",
  "Left deep femoral artery",
  "Right deep femoral artery",
  "Left popliteal artery",
  "Right popliteal artery",
  "Left anterior tibial artery",
  "Right anterior tibial artery",
  "Left posterior tibial artery",
  "Right posterior tibial artery",
  "Left fibular artery",
  "Right fibular artery",
  "Portal vein",
  "Superior vena cava",
  "Inferior vena cava",
] as const;

/** Colours of vessels with their names, in the order of their use. */
export const PALETTE = [
  ["#56b4e9","sky blue"],
  ["#cc79a7","pink"],
  ["#00b98a","green"],
  ["#b18cff","violet"],
  ["#8fdc6a","light green"],
  ["#ffa6dc","rose"],
  ["#3f6fe0","blue"],
  ["#8ff0e8","turquoise"],
  ["#c44df0","purple"],
  ["#2f8f9f","teal"],
  ["#9aa8b6","grey"],
  ["#ffffff","white"],
] as const;

/** What is taken unless the user chooses, by function and parameter. */
export const DEFAULTS = {
  'cpr.width': 50.0,
  'cpr.smoothing': 0.0,
  'cfa.radius': 10.0,
  'lumen_map.overlap': 0.0,
  'lumen_map.band[0]': -1.0,
  'lumen_map.band[1]': 3.0,
  'uncurl.amount': 0.5,
  'uncurling.frames': 48.0,
  'untangled.width': 25.0,
  'untangled.hull_margin': 2.0,
  'untangled.smoothing': 4.0,
  'cr.radius_offset': 50.0,
  'cr.arc_threshold': 150.0,
  'Focus.margin': 2.0,
  'Focus.fade': 6.0,
  'turntable.frames': 72.0,
  'flight.frames': 36.0,
  'measure.step': 0.5,
  'trace.stopper_radius': 3.0,
  'trace_mask.shortest_branch': 2.0,
} as const;

/** Smallest and largest pixel side of reformations by default (mm). */
export const PIXEL_SIDES = [
  0.05,
  0.25,
] as const;

/** Files that can be opened, in the words of messages. */
export const FILES = {
  'volumes': "a DICOM folder, file or zip archive, NIfTI (.nii, .nii.gz, .hdr + .img), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd)",
  'centerlines': "centerlines (.vtp, .vtk, .mrk.json, .fcsv, .pth, .swc, .tre, .csv)",
} as const;

/** File name extensions of volumes. */
export const VOLUME_EXTENSIONS = [
  ".nii",
  ".nii.gz",
  ".hdr",
  ".img",
  ".nrrd",
  ".nhdr",
  ".mha",
  ".mhd",
] as const;

/** File name extensions of centerlines. */
export const CENTERLINE_EXTENSIONS = [
  ".vtp",
  ".vtk",
  ".mrk.json",
  ".fcsv",
  ".pth",
  ".swc",
  ".tre",
  ".csv",
  ".txt",
  ".npy",
] as const;

/** Formats in which centerlines are saved. */
export const SAVED_CENTERLINES = [
  "vtp",
  "mrk.json",
] as const;

/** Name of the field that only sessions have. */
export const SESSION_FIELD = 'LumencutSession';

/** Constants of drags, the wheel and keys. */
export const GESTURES = {
  /** Movement above which a press becomes a drag (px). */
  drag_from: 4,
  /** Time below which two clicks are a double click (ms). */
  double_within: 350,
  /** Largest distance of the two clicks of a double click (px). */
  double_near: 6,
  /** Logarithm of the zoom per pixel of the wheel (1/px). */
  zoom_per_wheel: 0.0016,
  /** Most pixels of one wheel event that zoom (px). */
  most_wheel: 120,
  /** Pixels of a line of the wheel, in browsers that report lines (px). */
  wheel_line: 40,
  /** Wheel movement from which an event is a notch of a mouse; trackpads report less (px). */
  notch_from: 60,
  /** Wheel movement of a notch (px). */
  notch: 110,
  /** Lines of a notch, in browsers that report lines (1). */
  notch_lines: 3,
  /** Movement of a trackpad that scrolls one step (px). */
  scroll_step: 40,
  /** Movement of a trackpad to which the same movement of a finger is equal (1). */
  finger_gain: 4,
  /** Steps for each one, with Shift or a page key (1). */
  far_steps: 10,
  /** Drag to which an arrow key is equal (px). */
  key_step: 24,
  /** Zoom of the keys + and - (1). */
  key_zoom: 1.2,
  /** Rotation of a drag as long as the view is high (rad). */
  turn_per_height: 3.141592653589793,
  /** Smallest pixel spacing that zooming reaches (mm). */
  finest_spacing: 0.005,
  /** Largest pixel spacing that zooming reaches (mm). */
  coarsest_spacing: 20,
  /** Part of the window's width by which a drag changes it (1/px). */
  window_per_pixel: 0.004,
  /** Smallest width of a window, in values of the volume (value). */
  narrowest_window: 0.001,
} as const;

/** Side of a section picture in a report (pixels). */
export const SECTION_PIXELS = 300;

/** Half width of the uncertainty band, in standard deviations. */
export const DEVIATIONS = 2;
