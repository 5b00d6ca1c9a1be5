/** Status bar: position and value at the cross-hair, window, and compute device. */

import type { Vector } from '../core/messages';
import { nameOf } from '../state/changes';
import { hasMillimetres } from '../state/millimetres';
import { tree } from '../state/shown';
import * as store from '../state/store';
import { valueUnit } from '../state/value-unit';
import { Notes } from './Notes';

export function StatusBar() {
  return (
    <footer class="status">
      <output aria-label="Read-out" data-testid="readout">
        {readOut()}
      </output>
      <span class="spring" />
      {store.studyName.value && store.report.value && (
        <span class="study-name" data-testid="study-name" title={store.studyName.value}>
          {store.studyName.value}
        </span>
      )}
      <Notes />
      <span data-testid="window">{windowText()}</span>
      <span
        data-testid="device"
        title={store.started.value?.isIsolated === false ? 'Its server sends no COOP and COEP headers' : ''}
      >
        {deviceText()}
      </span>
      <span class="frame-time">
        {store.frameTime.value === null ? '' : `${store.frameTime.value.toFixed(0)} ms`}
      </span>
      <span class="notice">Not a medical device</span>
    </footer>
  );
}

/** Width and level of the grey-value window, in the notation of radiology. */
function windowText(): string {
  const [level, width] = store.window_.value;
  return store.hasVolume.value ? `W ${round(width)} L ${round(level)}` : '';
}

function round(value: number): string {
  return Math.abs(value) < 10 ? value.toPrecision(3) : value.toFixed(0);
}

function readOut(): string {
  const hair = store.crossHair.value;
  if (!hair) {
    return '';
  }
  const parts = [positionText(hair.point, store.states.value.orientation)];
  if (hair.value !== null) {
    parts.push(`${Number.isInteger(hair.value) ? hair.value : hair.value.toFixed(1)} ${valueUnit()}`);
  }
  if (hair.vessel !== null) {
    parts.push(vesselName(hair.vessel));
    if (hair.arcLength !== null) {
      parts.push(`${hair.arcLength.toFixed(1)}${hasMillimetres.value ? ' mm' : ''}`);
    }
  }
  return parts.join(' · ');
}

export function vesselName(vessel: number): string {
  const shown = tree.value[vessel];
  return shown ? nameOf(shown) : `vessel ${vessel + 1}`;
}

function deviceText(): string {
  const started = store.started.value;
  if (!started) {
    return 'starting';
  }
  if (started.isGpu) {
    return started.device ? `GPU: ${started.device}` : 'GPU';
  }
  const threads = started.threads === 1 ? '1 thread' : `${started.threads} threads`;
  return `CPU: ${threads}${started.isIsolated ? '' : ', because the page is not cross-origin isolated'}`;
}

const NAMES = [
  ['L', 'R'],
  ['P', 'A'],
  ['S', 'I'],
] as const;

/** A position such as `R 17.6 P 35.3 S 12.1` (mm); with x, y and z if the orientation is unknown. */
export function positionText(point: Vector, isOriented = true): string {
  if (!isOriented) {
    return point.map((part, axis) => `${'xyz'[axis]} ${part.toFixed(1)}`).join(' ');
  }
  return point
    .map((part, axis) => `${NAMES[axis]?.[part >= 0 ? 0 : 1]} ${Math.abs(part).toFixed(1)}`)
    .join(' ');
}
