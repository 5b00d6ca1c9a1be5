/** Below two scans: what is linked, pairs of places, the comparison of the picked vessels, and saving it. */
import { compareVessels, pairPlaces, saveComparison } from '../compare/comparing';
import { closeOther } from '../compare/other-page';
import { LINKS, type Link } from '../core/linked';
import { attempt } from '../output/save-actions';
import { showProblem } from '../state/store';
import {
  comparison,
  isBeside,
  isComparing,
  isOtherEarlier,
  isSameScan,
  linkAll,
  links,
  otherScan,
  pairs,
  removePairs,
  setOtherEarlier,
  toggleLink,
} from '../state/two-scans';
import { ScanNamed } from './SaveMenu';

const LINK_WORDS: Readonly<Record<Link, readonly [words: string, title: string]>> = {
  cameras: ['Cameras', 'Both scans turn, move and zoom together'],
  'cross-hairs': [
    'Cross-hairs',
    'The cross-hair is at the same place in both scans, on the compared vessel by arc length',
  ],
  slices: ['Slices', 'The slices of both scans have the same planes and slab'],
  layouts: ['Layouts', 'Both scans have the same layout'],
  windows: ['Windows', 'Both scans have the same window, if their values have the same unit'],
  looks: ['Looks', 'Both scans have the same look and settings'],
};

export function ComparisonBar() {
  if (!isBeside.value) {
    return null;
  }
  return (
    <section class="comparison-bar" aria-label="Two scans">
      {otherScan.value ? (
        <>
          {isSameScan.value && <strong role="status">Both are the same scan.</strong>}
          <Links />
          <Pairs />
          <Comparing />
          {comparison.value && <Saving />}
        </>
      ) : (
        <span>Open the other scan on the right.</span>
      )}
      <span class="spring" />
      <button type="button" onClick={closeOther}>
        Close other scan
      </button>
    </section>
  );
}

function Links() {
  const areAll = links.value.length === LINKS.length;
  return (
    <fieldset class="segments">
      <legend class="hidden-words">Linked</legend>
      <button
        type="button"
        aria-pressed={areAll}
        title={areAll ? 'Unlinks all' : 'Links all'}
        onClick={() => linkAll(!areAll)}
      >
        Link all
      </button>
      {LINKS.map((link) => {
        const [words, title] = LINK_WORDS[link];
        const isLinked = links.value.includes(link);
        return (
          <button
            key={link}
            type="button"
            aria-pressed={isLinked}
            title={title}
            onClick={() => toggleLink(link)}
          >
            {words}
          </button>
        );
      })}
    </fieldset>
  );
}

function Pairs() {
  const count = pairs.value.length;
  return (
    <span class="pairs">
      <button
        type="button"
        title="The cross-hairs of both scans are at the same place of the body: first unlink them. One pair shifts the other scan, three also turn it; pairs on the vessels match straight ones"
        onClick={() => void pairPlaces().catch(showProblem)}
      >
        Pair these places
      </button>
      {count > 0 && (
        <button type="button" onClick={removePairs}>
          {`Remove ${count === 1 ? '1 pair' : `${count} pairs`}`}
        </button>
      )}
    </span>
  );
}

function Comparing() {
  return (
    <>
      <select
        aria-label="Order of the scans"
        value={isOtherEarlier.value ? 'earlier' : 'later'}
        onChange={(event) => setOtherEarlier(event.currentTarget.value === 'earlier')}
      >
        <option value="earlier">The other scan is earlier</option>
        <option value="later">The other scan is later</option>
      </select>
      <button
        type="button"
        class="primary"
        disabled={isComparing.value}
        title="Measures the picked vessel of both scans, and shows where its diameter changed"
        onClick={() => void compareVessels()}
      >
        {isComparing.value ? 'Comparing …' : 'Compare the vessel'}
      </button>
    </>
  );
}

function Saving() {
  const kinds = [
    ['html', 'Save comparison'],
    ['csv', 'CSV'],
    ['json', 'JSON'],
  ] as const;
  return (
    <span class="pairs">
      {kinds.map(([kind, words]) => (
        <button key={kind} type="button" onClick={() => attempt(() => saveComparison(kind))}>
          {words}
        </button>
      ))}
      <ScanNamed />
    </span>
  );
}
