/** What the page knows: one store of signals, which the views read and the actions write. */
import { computed, signal } from '@preact/signals';
import type { Failure } from '../core/failure';
import type {
  Camera,
  Feature,
  Histogram,
  LineId,
  Method,
  Progress,
  Report,
  Roll,
  Settings,
  Started,
  States,
  Vector,
  Window,
} from '../core/messages';
import type { ScanStudy } from '../core/scan-study';

export type Layout = 'one' | 'two' | 'four' | 'strip' | 'measure' | 'report';
export const LAYOUTS: readonly Layout[] = ['one', 'two', 'four', 'strip', 'measure', 'report'];

/** The views that a layout shows. */
export type ViewName =
  | 'turning'
  | 'axial'
  | 'coronal'
  | 'sagittal'
  | 'straightened'
  | 'section'
  | 'profile'
  | 'numbers'
  | 'findings';

/** Where the cross-hair stands, and what is there. */
export interface CrossHair {
  readonly point: Vector;
  readonly value: number | null;
  readonly vessel: number | null;
  /** Along the vessel (mm). */
  readonly arcLength: number | null;
}

/** What computes; `epoch` counts how often it was exchanged. */
export const started = signal<Started | null>(null);
export const epoch = signal(0);

export const report = signal<Report | null>(null);
export const studyName = signal('');
export const notes = signal<readonly string[]>([]);
/** What the file says of its grid. */
export const states = signal<States>({ spacing: true, orientation: true });
/** The study of DICOM that the scan belongs to, as far as it is known. */
export const scanStudy = signal<ScanStudy | null>(null);
export const histogram = signal<Histogram | null>(null);
export const progress = signal<Progress | null>(null);
export const problem = signal<Failure | null>(null);

export const camera = signal<Camera | null>(null);
export const method = signal<Method>('csr');
/** The look that the page begins with: the cut around the vessels amid the body. */
const FIRST_LOOK = 'focus';
/** The settings that the page begins with: its lines are white, as yellow warns in it. */
export const firstSettings = computed<Settings>(() => ({
  ...started.value?.looks.find(({ name }) => name === FIRST_LOOK)?.settings,
  silhouette_color: [255, 255, 255],
}));
/** The settings that differ from their defaults, but for windows. */
export const settings = signal<Settings>(firstSettings.value);
export const window_ = signal<Window>([300, 900]);
/** Light where values are low. */
export const isInverted = signal(false);
export const isTurning = signal(false);

export const crossHair = signal<CrossHair | null>(null);
/** Where the cross-hair stood as the study began: a reader who did not move it means nothing by it. */
export const firstPlace = signal<Vector | null>(null);
/** The vessel of the CPR, and the place of the section on it (mm). */
export const pickedVessel = signal<number | null>(null);
export const pickedPlace = signal(0);
/** Rotation of the CPR about its vessel (radians). */
export const cprAngle = signal(0);
/** Which value of a half circle the CPR shows (CFA). */
export const cprFeature = signal<Feature | null>(null);
/** Which side of the lumen the rows of the CPR follow; null where all have its rotation. */
export const cprRoll = signal<Roll | null>(null);

export const layout = signal<Layout>('strip');
export const maximised = signal<ViewName | null>(null);
/** How often the views were reset: flat views then show all of the volume again. */
export const resets = signal(0);
export const isHelpOpen = signal(false);
/** The camera whose view is shown with all its pixels, since it last changed. */
export const settled = signal<Camera | null>(null);
export const frameTime = signal<number | null>(null);

export const hasVolume = computed(() => Boolean(report.value?.volume));
export const hasTree = computed(() => (report.value?.vessels?.length ?? 0) > 0);

/** The line of the vessel that is picked: another one where the vessel was traced anew. */
export const pickedLine = (): LineId | null =>
  report.value?.vessels?.[pickedVessel.value ?? -1]?.line ?? null;

/** The settings of the turning view, with the windows. */
export const viewSettings = computed<Settings>(() => {
  const chosen: Record<string, Settings[string]> = { ...settings.value };
  const windows = report.value?.windows;
  const context = 'context' in chosen ? chosen.context : 'mida';
  chosen.window = window_.value;
  const own = windows?.contexts[String(context)];
  if (windows && own) {
    chosen.context_window = moved(own, windows.main, window_.value);
  }
  return chosen;
});

/** A window of its own, moved and widened as the user did with the main one. */
export function moved(own: Window, from: Window, to: Window): Window {
  const factor = to[1] / from[1];
  return [to[0] + (own[0] - from[0]) * factor, own[1] * factor];
}
