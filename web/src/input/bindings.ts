/** All mouse, touch and key bindings. The help is generated from this table. */

/** Where a binding applies: in a view, everywhere, in any view while tracing, or on a focused marker. */
export type Where = 'turning' | 'flat' | 'everywhere' | 'tracing' | 'marks';
export type Gesture =
  | 'drag'
  | 'wheel'
  | 'click'
  | 'double click'
  | 'touch drag'
  | 'two-finger drag'
  | 'pinch'
  | 'key';
export type Button = 'left' | 'middle' | 'right';
export type Modifier = '' | 'Shift' | 'Ctrl' | 'Alt';
/** Edits of the vessels, performed by `edit/performing.ts`. */
export type EditAction =
  | 'trace'
  | 'branches'
  | 'whole vessel'
  | 'vessels'
  | 'enter'
  | 'remove point'
  | 'remove'
  | 'accept doubt'
  | 'leave doubt out'
  | 'next doubt'
  | 'previous doubt'
  | 'undo'
  | 'redo';

export type Action =
  | 'rotate'
  | 'rotate about vessel'
  | 'pan'
  | 'zoom'
  | 'window'
  | 'scroll'
  | 'scroll by ten'
  | 'step'
  | 'pick'
  | 'move cross-hair'
  | 'maximise'
  | 'cancel'
  | 'reset'
  | 'invert'
  | 'context'
  | 'silhouettes'
  | 'measure'
  | 'report'
  | 'best view'
  | 'turn about place'
  | 'turn planes'
  | 'turn'
  | 'help'
  | 'pane'
  | 'save session'
  | 'save report'
  | 'set point'
  | 'end vessel'
  | 'add point'
  | EditAction
  | `view ${string}`
  | `preset ${number}`;

export interface Binding {
  readonly where: Where;
  readonly gesture: Gesture;
  readonly button?: Button;
  readonly modifier?: Modifier;
  readonly key?: string;
  readonly action: Action;
  readonly words: string;
}

const mouse = (where: Where, button: Button, modifier: Modifier, action: Action, words: string): Binding => ({
  where,
  gesture: 'drag',
  button,
  modifier,
  action,
  words,
});
const other = (
  where: Where,
  gesture: Gesture,
  modifier: Modifier,
  action: Action,
  words: string,
): Binding => ({
  where,
  gesture,
  modifier,
  action,
  words,
});
const key = (name: string, action: Action, words: string): Binding => ({
  where: 'everywhere',
  gesture: 'key',
  key: name,
  action,
  words,
});

const withCtrl = (name: string, action: Action, words: string): Binding => ({
  ...key(name, action, words),
  modifier: 'Ctrl',
});

/** A row of the help for keys that the focused view or marker handles itself. */
const pane = (where: Where, name: string, words: string): Binding => ({
  where,
  gesture: 'key',
  key: name,
  action: 'pane',
  words,
});

export const BINDINGS: readonly Binding[] = [
  mouse('turning', 'left', '', 'rotate', 'rotate'),
  mouse('turning', 'left', 'Alt', 'rotate about vessel', 'rotate about the axis of the picked vessel'),
  mouse('turning', 'left', 'Ctrl', 'window', 'window: drag across for width, up or down for level'),
  mouse('turning', 'left', 'Shift', 'pan', 'pan'),
  mouse('turning', 'middle', '', 'pan', 'pan'),
  mouse('turning', 'right', '', 'window', 'window: drag across for width, up or down for level'),
  other('turning', 'wheel', '', 'zoom', 'zoom at the pointer'),
  other('turning', 'wheel', 'Ctrl', 'zoom', 'zoom at the pointer'),
  other('turning', 'wheel', 'Shift', 'zoom', 'zoom at the pointer'),
  other('turning', 'touch drag', '', 'rotate', 'rotate'),
  mouse('flat', 'left', '', 'pan', 'pan'),
  mouse('flat', 'left', 'Ctrl', 'window', 'window: drag across for width, up or down for level'),
  mouse('flat', 'left', 'Shift', 'pan', 'pan'),
  mouse('flat', 'middle', '', 'pan', 'pan'),
  mouse('flat', 'right', '', 'window', 'window: drag across for width, up or down for level'),
  other('flat', 'wheel', '', 'scroll', 'scroll by one slice, or rotate the straightened vessel'),
  other('flat', 'wheel', 'Shift', 'scroll by ten', 'scroll by ten'),
  other('flat', 'wheel', 'Ctrl', 'zoom', 'zoom at the pointer'),
  other('flat', 'touch drag', '', 'scroll', 'scroll'),
  other('tracing', 'click', '', 'set point', 'set a point of the vessel, or a stopper'),
  other('tracing', 'wheel', 'Alt', 'step', 'step to the lumen behind the one under the pointer, or back'),
  other('tracing', 'double click', '', 'end vessel', 'end the vessel; on a curve, add a point there'),
  {
    where: 'tracing',
    gesture: 'click',
    button: 'right',
    action: 'add point',
    words: 'on a curve, add a point; on a point, remove it',
  },
  pane('tracing', 'Drag a point', 'move the point; arrow keys move the focused point'),
  pane('tracing', 'Arrows in a slice', 'move the cross-hair by a voxel, with Shift by ten'),
  pane('tracing', 'Page up and down', 'scroll through the slices, with Shift by ten'),
  key(
    'Enter',
    'enter',
    'while tracing, set a point at the cross-hair; press again for the whole vessel, or to end a vessel with several points',
  ),
  key(
    'Delete',
    'remove',
    'while tracing, remove the last point; otherwise delete the picked vessel in the list',
  ),
  key('Backspace', 'remove point', 'while tracing, remove the last point'),
  other('everywhere', 'two-finger drag', '', 'pan', 'pan'),
  other('everywhere', 'pinch', '', 'zoom', 'zoom'),
  other('everywhere', 'click', '', 'pick', 'move the cross-hair to the pointer'),
  other('everywhere', 'double click', '', 'maximise', 'show this view alone, or all views again'),
  pane('turning', 'Arrow keys', 'rotate; with Shift pan'),
  pane('turning', '+ and -', 'zoom'),
  pane('turning', 'Drag to the side', 'while turning about a place: rotate the cut around it'),
  pane('flat', 'Up and down', 'scroll'),
  pane('flat', 'Page up and down', 'scroll by ten'),
  pane('flat', 'Left and right', 'turn the planes of the other slices by 5°, while their lines are shown'),
  pane('flat', '+ and -', 'zoom'),
  pane('marks', 'Arrow keys', 'move the marker along the vessel, with Shift ten times as far'),
  pane('marks', 'Enter', 'confirm a suggested place'),
  pane('marks', 'Delete', 'remove the marker; a right click does so too'),
  key(
    'Escape',
    'cancel',
    'cancel the current action; otherwise end the vessel, leave the tool, or show all views',
  ),
  key('a', 'view anterior', 'view from the front (anterior)'),
  key('p', 'view posterior', 'view from the back (posterior)'),
  key('l', 'view left', "view from the patient's left"),
  key('R', 'view right', "view from the patient's right (Shift+r)"),
  key('S', 'view superior', 'view from above (superior, Shift+s)'),
  key('I', 'view inferior', 'view from below (inferior, Shift+i)'),
  key('r', 'reset', 'reset the views and the window'),
  key('i', 'invert', 'invert black and white'),
  key('1', 'preset 0', 'window suggested by the data'),
  key('2', 'preset 1', 'window for CT angiography'),
  key('3', 'preset 2', 'window for soft tissue'),
  key('4', 'preset 3', 'window for bone'),
  key('5', 'preset 4', 'window for lung'),
  key('6', 'preset 5', 'window from the smallest to the largest value'),
  key('7', 'preset 6', 'window for MR angiography'),
  key('8', 'preset 7', 'window for stents'),
  key('9', 'preset 8', 'window for aneurysm sac'),
  key('c', 'context', 'show or hide the context, the body around the cut'),
  key('s', 'silhouettes', 'show or hide silhouette lines'),
  key('m', 'measure', 'measure the picked vessel, or return to the previous layout'),
  key('e', 'report', 'report the findings on all vessels, or return to the previous layout'),
  key('f', 'best view', 'best view of the picked vessel'),
  key('o', 'turn about place', 'start or stop turning the view about the vessel at the section'),
  key('x', 'turn planes', 'show or hide the lines of the planes in the slices, to turn and move them'),
  key(' ', 'turn', 'start or stop a slow rotation'),
  key('t', 'trace', 'start or stop tracing vessels by clicks'),
  key('w', 'whole vessel', 'while tracing, trace the whole vessel at the clicked point'),
  key('b', 'branches', 'find all branches from the cross-hair'),
  key('v', 'vessels', 'show or hide the list of vessels'),
  key('.', 'next doubt', 'show the next doubtful branch'),
  key(',', 'previous doubt', 'show the previous doubtful branch'),
  key('y', 'accept doubt', 'accept the doubtful branch that is shown'),
  key('n', 'leave doubt out', 'leave out the doubtful branch that is shown'),
  withCtrl('z', 'undo', 'undo'),
  withCtrl('Z', 'redo', 'redo'),
  withCtrl('y', 'redo', 'redo'),
  withCtrl('s', 'save session', 'save the session'),
  withCtrl('S', 'save report', 'save the report'),
  key('?', 'help', 'show this help'),
];

/** Action of a drag, wheel or click in a view; null if there is no binding. */
export function actionOf(
  where: Where,
  gesture: Gesture,
  button: Button | null,
  modifier: Modifier,
): Action | null {
  const fits = (row: Binding) =>
    (row.where === where || row.where === 'everywhere') &&
    row.gesture === gesture &&
    (row.button ?? null) === button &&
    (row.modifier ?? '') === modifier;
  return BINDINGS.find(fits)?.action ?? null;
}

/** Action of a key; a capital letter without a binding acts like its small letter. */
export function actionOfKey(name: string, modifier: Modifier = ''): Action | null {
  const rowOf = (key: string) =>
    BINDINGS.find((row) => row.gesture === 'key' && row.key === key && (row.modifier ?? '') === modifier);
  return (rowOf(name) ?? rowOf(name.toLowerCase()))?.action ?? null;
}

/** The key that the user means: Shift makes capitals, Caps Lock does not. */
export function keyOf({ key, shiftKey }: Pick<KeyboardEvent, 'key' | 'shiftKey'>): string {
  const [small, capital] = [key.toLowerCase(), key.toUpperCase()];
  const isLetter = key.length === 1 && small !== capital;
  return isLetter ? (shiftKey ? capital : small) : key;
}

export function inputName(row: Binding): string {
  const name = row.gesture === 'key' ? keyName(row.key ?? '') : buttonName(row);
  return row.modifier ? `${row.modifier}+${name}` : name;
}

function keyName(key: string): string {
  const isCapital = key.length === 1 && key !== key.toLowerCase();
  return key === ' ' ? 'Space' : isCapital ? `Shift+${key.toLowerCase()}` : key;
}

const buttonName = ({ button, gesture }: Binding): string => (button ? `${button} ${gesture}` : gesture);
