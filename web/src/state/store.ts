/** The state of the page, as signals. Actions change it, and the views show it. */
import { batch, computed, signal } from '@preact/signals';
import { Failure } from '../core/failure';
import type {
  Camera,
  Feature,
  Histogram,
  LineId,
  Method,
  Progress,
  Report,
  Roll,
  ScanStudy,
  Settings,
  Slices,
  Started,
  States,
  Vector,
  VesselDoubt,
  Window,
} from '../core/messages';
import { STANDARD } from '../core/planes';

export type Layout = 'one' | 'two' | 'four' | 'strip' | 'measure' | 'report';
export const LAYOUTS: readonly Layout[] = ['one', 'two', 'four', 'strip', 'measure', 'report'];

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

export interface CrossHair {
  readonly point: Vector;
  readonly value: number | null;
  readonly vessel: number | null;
  /** Arc length of the cross-hair on its vessel (mm). */
  readonly arcLength: number | null;
}

/** What the engine reported when it started. `epoch` counts the changes of the compute device. */
export const started = signal<Started | null>(null);
export const epoch = signal(0);

export const report = signal<Report | null>(null);
export const studyName = signal('');
export const notes = signal<readonly string[]>([]);
export const vesselDoubts = signal<readonly VesselDoubt[]>([]);
export const states = signal<States>({ spacing: true, orientation: true });
export const scanStudy = signal<ScanStudy | null>(null);
export const histogram = signal<Histogram | null>(null);
export const progress = signal<Progress | null>(null);
export const problem = signal<Failure | null>(null);

export const camera = signal<Camera | null>(null);
export const method = signal<Method>('csr');
const FIRST_LOOK = 'focus';
/** Initial view settings. Edge lines are white, because yellow signals warnings. */
export const firstSettings = computed<Settings>(() => ({
  ...started.value?.looks.find(({ name }) => name === FIRST_LOOK)?.settings,
  silhouette_color: [255, 255, 255],
}));
/** View settings that differ from the defaults, except windows. */
export const settings = signal<Settings>(firstSettings.value);
export const window_ = signal<Window>([300, 900]);
export const isInverted = signal(false);
export const isTurning = signal(false);

export const crossHair = signal<CrossHair | null>(null);
/** Initial position of the cross-hair; if it is still there, the user has not placed it. */
export const firstPlace = signal<Vector | null>(null);
export const pickedVessel = signal<number | null>(null);
export const pickedPlace = signal(0);
export const cprAngle = signal(0);
export const cprFeature = signal<Feature | null>(null);
/** Which side of the lumen the CPR follows, narrowest or widest; null for a constant rotation. */
export const cprRoll = signal<Roll | null>(null);

export const slices = signal<Slices>(STANDARD);

export const layout = signal<Layout>('strip');
export const maximised = signal<ViewName | null>(null);
/** Counts resets of the views; at each one, slices show the whole volume again. */
export const resets = signal(0);
export const isHelpOpen = signal(false);
/** The camera of the last picture that was displayed in full quality. */
export const completeCamera = signal<Camera | null>(null);
export const frameTime = signal<number | null>(null);

export const hasVolume = computed(() => Boolean(report.value?.volume));
export const hasTree = computed(() => (report.value?.vessels?.length ?? 0) > 0);

/** Line number of the picked vessel. It changes when the vessel is retraced. */
export const pickedLine = (): LineId | null =>
  report.value?.vessels?.[pickedVessel.value ?? -1]?.line ?? null;

/** Lines of more vessels than this crowd the view, so they are drawn only if the user chooses them. */
export const MOST_WITH_LINES = 40;

/** The chosen settings, and those that depend on the scan. */
export const ownSettings = computed<Settings>(() =>
  (report.value?.vessels?.length ?? 0) > MOST_WITH_LINES
    ? { silhouettes: false, ...settings.value }
    : settings.value,
);

export const viewSettings = computed<Settings>(() => {
  const chosen: Record<string, Settings[string]> = { ...ownSettings.value };
  const windows = report.value?.windows;
  const context = 'context' in chosen ? chosen.context : 'mida';
  chosen.window = window_.value;
  const own = windows?.contexts[String(context)];
  if (windows && own) {
    const isChosen = window_.value.some((value, n) => value !== windows.main[n]);
    // Smallest values are far below the vessels, so a window for those would show them white.
    const isOwn = context === 'minip' && isChosen;
    chosen.context_window = isOwn ? window_.value : moved(own, windows.main, window_.value);
  }
  return chosen;
});

/** Changes the window `own` in the same way as the main window changed from `from` to `to`. */
export function moved(own: Window, from: Window, to: Window): Window {
  const factor = to[1] / from[1];
  return [to[0] + (own[0] - from[0]) * factor, own[1] * factor];
}

export function showProblem(error: unknown): void {
  problem.value = Failure.of(error);
}

export function setProblem(failure: Failure | null): void {
  problem.value = failure;
}

export const closeProblem = (): void => setProblem(null);

export function showProgress(now: Progress | null): void {
  progress.value = now;
}

export function setNotes(all: readonly string[]): void {
  notes.value = all;
}

export function addNotes(more: readonly string[]): void {
  notes.value = [...new Set([...notes.value, ...more])];
}

export function addDoubts(more: readonly VesselDoubt[]): void {
  vesselDoubts.value = [...vesselDoubts.value, ...more];
}

export function setCamera(to: Camera): void {
  camera.value = to;
}

export function setCompleteCamera(of: Camera | null): void {
  completeCamera.value = of;
}

export function setFrameTime(milliseconds: number): void {
  frameTime.value = milliseconds;
}

export function chooseMethod(name: Method): void {
  method.value = name;
}

export function putBackSettings(before: Settings, window: Window): void {
  settings.value = before;
  window_.value = window;
}

export function resetSettings(): void {
  settings.value = firstSettings.value;
}

export function setLayout(to: Layout): void {
  layout.value = to;
}

export function closeHelp(): void {
  isHelpOpen.value = false;
}

export function pickVessel(vessel: number, at = pickedPlace.value): void {
  batch(() => {
    pickedVessel.value = vessel;
    pickedPlace.value = at;
  });
}

export function putCrossHair(point: Vector): void {
  crossHair.value = { point, value: null, vessel: null, arcLength: null };
}

export function setCrossHair(to: CrossHair): void {
  crossHair.value = to;
}

/** Rotation per wheel step over a CPR, or per arrow key in a slice (radians). */
export const TURN_STEP = Math.PI / 36;

export function turnCpr(steps: number): void {
  cprAngle.value += steps * TURN_STEP;
}

export function setCprAngle(degrees: number): void {
  cprAngle.value = (degrees * Math.PI) / 180;
}

/** What a pixel of the CPR shows: a feature across the vessel, or the side that it follows. */
export function chooseCpr({
  roll,
  feature,
}: {
  readonly roll: Roll | null;
  readonly feature: Feature | null;
}): void {
  batch(() => {
    cprRoll.value = roll;
    cprFeature.value = feature;
  });
}
