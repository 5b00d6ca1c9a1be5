import type { ComponentChildren } from 'preact';
import { useMeasuring } from '../measure/asking';
import { ProfilePane } from '../measure/ProfilePane';
import { columns, rows, toggleMaximised } from '../state/panels';
import {
  chooseReformation,
  REFORMATIONS,
  type ReformationKind,
  reformationKind,
  reformationTitle,
} from '../state/reformation';
import { sliceWords } from '../state/slices';
import { layout, maximised, type Layout as Name, type ViewName } from '../state/store';
import { CprView } from '../views/CprView';
import { ReformedView } from '../views/ReformedView';
import { SectionView } from '../views/SectionView';
import { SliceView } from '../views/SliceView';
import { TurningView } from '../views/TurningView';
import { Divider } from './Divider';
import { FindingsPanel } from './FindingsPanel';
import { LooksBar } from './LooksBar';
import { NumbersPanel } from './NumbersPanel';

const VIEWS: Readonly<Record<Name, readonly ViewName[]>> = {
  one: ['turning'],
  two: ['turning', 'straightened'],
  four: ['turning', 'axial', 'coronal', 'sagittal'],
  strip: ['turning', 'axial', 'straightened', 'section'],
  measure: ['turning', 'section', 'numbers', 'profile'],
  report: ['turning', 'findings'],
};
const TITLES: Readonly<Record<ViewName, string>> = {
  turning: 'Vessels',
  axial: 'Axial',
  coronal: 'Coronal',
  sagittal: 'Sagittal',
  straightened: 'Straightened vessel',
  section: 'Section',
  profile: 'Profile',
  numbers: 'Numbers',
  findings: 'Findings',
};

export function Layout() {
  const shown = VIEWS[layout.value];
  const alone = maximised.value;
  const row = rows[layout.value];
  useMeasuring();
  return (
    <main
      class={`layout ${layout.value}${alone ? ' alone' : ''}`}
      data-layout={layout.value}
      style={{
        '--column': `${100 * columns[layout.value].value}%`,
        '--row': `${100 * (row?.value ?? 0.5)}%`,
      }}
    >
      {shown.map((name) => (
        <Pane key={name} name={name} isHidden={alone !== null && alone !== name}>
          {viewOf(name)}
        </Pane>
      ))}
      {!alone && layout.value !== 'one' && (
        <Divider words="Width of the left views" between="column" place={columns[layout.value]} />
      )}
      {!alone && row && <Divider words="Height of the upper views" between="row" place={row} />}
    </main>
  );
}

function viewOf(name: ViewName) {
  switch (name) {
    case 'turning':
      return <TurningView />;
    case 'straightened':
      return <VesselPane />;
    case 'section':
      return <SectionView />;
    case 'profile':
      return <ProfilePane />;
    case 'numbers':
      return <NumbersPanel />;
    case 'findings':
      return <FindingsPanel />;
    default:
      return <SliceView name={name} />;
  }
}

interface PaneProps {
  readonly name: ViewName;
  readonly isHidden: boolean;
  readonly children: ComponentChildren;
}

function Pane({ name, isHidden, children }: PaneProps) {
  const isAlone = maximised.value === name;
  return (
    <section class={`pane ${name}${isHidden ? ' hidden' : ''}`} aria-label={TITLES[name]}>
      {name === 'turning' && <LooksBar />}
      {children}
      <h2 class="pane-title">{titleOf(name)}</h2>
      <button
        type="button"
        class="pane-button"
        onClick={() => toggleMaximised(name)}
        aria-label={isAlone ? 'Show all views' : `Show ${TITLES[name]} alone`}
      >
        {isAlone ? '⤡' : '⤢'}
      </button>
    </section>
  );
}

function titleOf(name: ViewName): string {
  const isSlice = name === 'axial' || name === 'coronal' || name === 'sagittal';
  const words = isSlice ? sliceWords(name) : '';
  return name === 'straightened' ? reformationTitle() : TITLES[name] + (words && `, ${words}`);
}

/** Shows the picked vessel as straightened CPR or in another reformation. */
function VesselPane() {
  const kind = reformationKind.value;
  return (
    <>
      {kind === 'cpr' ? <CprView /> : <ReformedView key={kind} kind={kind} />}
      <ReformationChoice />
    </>
  );
}

function ReformationChoice() {
  return (
    <select
      class="reformation-choice"
      aria-label="Reformation"
      value={reformationKind.value}
      onChange={(event) => chooseReformation(event.currentTarget.value as ReformationKind)}
    >
      {REFORMATIONS.map(([kind, words]) => (
        <option key={kind} value={kind}>
          {words}
        </option>
      ))}
    </select>
  );
}
