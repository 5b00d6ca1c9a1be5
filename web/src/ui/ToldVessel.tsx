/** What is told of the vessel that was traced last: its length, what it joins, and where it is doubtful, to look at and to cut. */
import { engine } from '../client/shared';
import { tree } from '../edit/shown';
import { told } from '../edit/telling';
import { cut } from '../edit/vessels';
import { moveTo } from '../link/along';
import { pickedVessel } from '../state/store';

export function ToldVessel() {
  if (!told.value) {
    return null;
  }
  const { vessel, words, doubts } = told.value;
  return (
    <>
      <span>{words}</span>
      {doubts.map(({ words, at }) => (
        <>
          <span>{words}</span>
          {at !== null && (
            <>
              <button type="button" onClick={() => goTo(vessel, at)}>
                Go there
              </button>
              <button type="button" onClick={() => void cut(engine, vessel, at)}>
                Cut there
              </button>
            </>
          )}
        </>
      ))}
    </>
  );
}

/** Puts section and cross-hair on a vessel of the document, at an arc length (mm). */
function goTo(vessel: number, at: number): void {
  const place = tree.value.findIndex(({ id }) => id === vessel);
  if (place >= 0) {
    pickedVessel.value = place;
    moveTo(at);
  }
}
