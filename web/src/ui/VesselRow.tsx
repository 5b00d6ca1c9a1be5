/** A row of the vessel list. The row of the picked vessel has buttons for it. */
import { useEffect, useRef, useState } from 'preact/hooks';
import type { DocumentVessel } from '../core/messages';
import { cut, hide, join, recolor, remove, rename } from '../edit/vessels';
import { nameOf, PALETTE } from '../state/changes';
import { document_ } from '../state/history';
import { lengthOf } from '../state/lines';
import { hasMillimetres } from '../state/millimetres';
import { goToVessel, pickedId, pickOnceShown, tree } from '../state/shown';
import { pickedPlace, report } from '../state/store';
import {
  endHighlight,
  factsOf,
  highlight,
  isTreeShown,
  marked,
  suggestedNameOf,
  sure,
} from '../state/tidying';
import { extend, takeTool } from '../state/tool';
import { BestViewButton } from './BestViewButton';
import { LineByHand, LineTools } from './LineTools';

export const NAMES_TO_OFFER = 'names-to-offer';

interface RowProps {
  readonly vessel: DocumentVessel;
}

/** Most levels of indentation that fit in the narrow list, and the width of one (CSS pixels). */
const DEEPEST = 4;
const INDENT = 7;

const NO_DECIMALS_FROM_MM = 9.95;

export function VesselRow({ vessel, depth }: RowProps & { readonly depth: number }) {
  const isPicked = vessel.id === pickedId();
  const name = nameOf(vessel);
  const row = useRef<HTMLLIElement>(null);
  // Scrolls to this row when its vessel is picked in a view.
  useEffect(() => {
    if (isPicked) {
      row.current?.scrollIntoView({ block: 'nearest' });
    }
  }, [isPicked]);
  return (
    <li
      ref={row}
      class={rowClass(isPicked, marked.value.has(vessel.id))}
      data-vessel={vessel.id}
      data-depth={depth}
      style={{ marginLeft: `${INDENT * Math.min(depth, DEEPEST)}px` }}
      {...lighting(vessel)}
    >
      <input
        type="radio"
        name="picked-vessel"
        checked={isPicked}
        disabled={vessel.isHidden}
        aria-label={`Show ${name} straightened`}
        onChange={() => pick(vessel)}
      />
      <ColorChoice vessel={vessel} />
      <NameField vessel={vessel} isPicked={isPicked} />
      <span class="length" title={calibreWords(vessel)}>
        {isTreeShown.value ? sizeText(vessel) : `${lengthText(vessel)}${hasMillimetres.value ? ' mm' : ''}`}
      </span>
      <button
        type="button"
        class="eye"
        aria-pressed={!vessel.isHidden}
        aria-label={vessel.isHidden ? `Show ${name}` : `Hide ${name}`}
        title={vessel.isHidden ? 'Show' : 'Hide'}
        onClick={() => void hide(vessel.id, !vessel.isHidden)}
      >
        {vessel.isHidden ? '◌' : '◉'}
      </button>
      <SuggestedName vessel={vessel} />
      <LineByHand vessel={vessel} />
      {isPicked && !vessel.isHidden ? <VesselActions vessel={vessel} /> : null}
    </li>
  );
}

const rowClass = (isPicked: boolean, isMarked: boolean): string =>
  `${isPicked ? 'picked' : ''}${isMarked ? ' marked' : ''}`;

export const lighting = ({ id }: DocumentVessel) => ({
  onPointerEnter: () => highlight(id),
  onPointerLeave: () => endHighlight(id),
});

/** The vessel name. A click picks the vessel; a click if it is picked, a double click, Enter or F2 edits the name. */
function NameField({ vessel, isPicked }: RowProps & { readonly isPicked: boolean }) {
  const [typed, setTyped] = useState<string | null>(null);
  const begin = (field: HTMLInputElement) => {
    if (typed === null) {
      setTyped(vessel.name);
      field.select();
    }
  };
  return (
    <input
      class="name"
      readOnly={typed === null}
      title={typed === null ? nameOf(vessel) : ''}
      list={NAMES_TO_OFFER}
      value={typed ?? vessel.name}
      placeholder={nameOf(vessel)}
      aria-label={`Name of ${nameOf(vessel)}`}
      onClick={(event) => (isPicked ? begin(event.currentTarget) : pickShown(vessel))}
      onDblClick={(event) => begin(event.currentTarget)}
      onKeyDown={(event) => {
        if (event.key === 'F2' || (event.key === 'Enter' && typed === null)) {
          begin(event.currentTarget);
        }
      }}
      onInput={(event) => setTyped(event.currentTarget.value)}
      onChange={(event) => void rename(vessel.id, event.currentTarget.value.trim())}
      onBlur={() => setTyped(null)}
    />
  );
}

/** A name for the user to confirm; only a click gives it to the vessel. */
function SuggestedName({ vessel }: RowProps) {
  const suggested = suggestedNameOf(vessel);
  return suggested === null ? null : (
    <button
      type="button"
      class="suggested"
      title="Suggested by place, course, width and branches. Click to use this name."
      onClick={() => void rename(vessel.id, suggested)}
    >
      {`${suggested}?`}
    </button>
  );
}

function pickShown(vessel: DocumentVessel): void {
  if (!vessel.isHidden) {
    pick(vessel);
  }
}

/** The length; while the vessel is retraced, its previous length, or `…` if that is unknown. */
function lengthText({ id, line }: DocumentVessel): string {
  const shown = report.value?.vessels ?? [];
  const before = shown[tree.value.findIndex((vessel) => vessel.id === id)];
  const now = shown.find((vessel) => vessel.line === line)?.length ?? lengthOf(line);
  const length = now || (before?.length ?? 0);
  return length > 0 ? length.toFixed(1) : '…';
}

/** Median diameter × length, short to leave room for the name. */
function sizeText(vessel: DocumentVessel): string {
  const { calibre = null, length } = factsOf(vessel) ?? {};
  return calibre === null || length === undefined
    ? lengthText(vessel)
    : `${calibre.toFixed(calibre < NO_DECIMALS_FROM_MM ? 1 : 0)} × ${length.toFixed(0)}`;
}

function calibreWords(vessel: DocumentVessel): string {
  const { calibre = null, parent = null } = factsOf(vessel) ?? {};
  const trunk = sure.value.find((one) => one.line === parent);
  return [
    ...(calibre === null ? [] : [`median diameter ${calibre.toFixed(1)}`]),
    ...(trunk ? [`branch of ${nameOf(trunk)}`] : []),
  ].join(', ');
}

function ColorChoice({ vessel }: RowProps) {
  return (
    <select
      class="swatch"
      style={{ background: vessel.color, color: vessel.color }}
      value={vessel.color}
      aria-label={`Colour of ${nameOf(vessel)}`}
      onChange={(event) => void recolor(vessel.id, event.currentTarget.value)}
    >
      {PALETTE.map(([color, words]) => (
        <option key={color} value={color} style={{ background: color, color: '#000' }}>
          {words}
        </option>
      ))}
    </select>
  );
}

function VesselActions({ vessel }: RowProps) {
  const { id } = vessel;
  const others = document_.value.vessels.filter((one) => one.id !== id && one.doubt === null);
  const goOn = () => {
    takeTool('trace');
    extend(id);
  };
  return (
    <div class="buttons">
      <BestViewButton />
      {vessel.clicks && (
        <button type="button" title="Adds points at the end of this vessel" onClick={goOn}>
          Extend
        </button>
      )}
      <button
        type="button"
        title="Cuts the vessel at the section"
        onClick={() => void cut(id, pickedPlace.value)}
      >
        Cut here
      </button>
      <LineTools vessel={vessel} />
      {others.length > 0 && (
        <select
          value=""
          aria-label={`Join ${nameOf(vessel)} with`}
          onChange={(event) => void join(id, Number(event.currentTarget.value))}
        >
          <option value="">Join with …</option>
          {others.map((other) => (
            <option key={other.id} value={other.id}>
              {nameOf(other)}
            </option>
          ))}
        </select>
      )}
      <button type="button" onClick={() => void remove([id])}>
        Delete
      </button>
    </div>
  );
}

/** Picks a vessel, and moves all views to half its length. A hidden vessel is picked once displayed. */
function pick({ id }: DocumentVessel): void {
  pickOnceShown(id);
  goToVessel(id, null);
}
