/** The frame with the other scan: a second page of the viewer, which has its own engine, tools and undo. */
import { useEffect } from 'preact/hooks';
import { connect, disconnect } from '../compare/other-page';
import { showProblem, studyName } from '../state/store';
import { isBeside, isOtherEarlier, otherScan } from '../state/two-scans';

/** The address of this page with the parts that concern its engine, as a companion without scan. */
function address(): string {
  const own = new URLSearchParams(window.location.search);
  const kept = ['device', 'test'].flatMap((name) => (own.has(name) ? [[name, own.get(name) ?? '']] : []));
  return `?${new URLSearchParams([['companion', ''], ...kept])}`;
}

export function ScanNames() {
  if (!isBeside.value) {
    return null;
  }
  const [own, other] = isOtherEarlier.value ? ['Later', 'Earlier'] : ['Earlier', 'Later'];
  return (
    <div class="scan-names">
      <span>{`${own} scan: ${studyName.value}`}</span>
      <span>{otherScan.value ? `${other} scan: ${otherScan.value.name}` : 'Other scan'}</span>
    </div>
  );
}

export function OtherScan() {
  useEffect(() => disconnect, []);
  if (!isBeside.value) {
    return null;
  }
  return (
    <iframe
      class="other-scan"
      title="Other scan"
      src={address()}
      onLoad={({ currentTarget }) => {
        if (currentTarget.contentWindow) {
          connect(currentTarget.contentWindow).catch(showProblem);
        }
      }}
    />
  );
}
