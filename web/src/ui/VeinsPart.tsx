/** The vessels that seem to be veins or parts of the heart, as a group that one click hides. */
import { hideAll } from '../edit/vessels';
import { veinsAndHeart } from '../state/tidying';

export function VeinsPart() {
  const vessels = veinsAndHeart.value;
  if (vessels.length === 0) {
    return null;
  }
  const isHidden = vessels.every((vessel) => vessel.isHidden);
  return (
    <div class="buttons">
      <span title="Suggested by brightness and place, compared with the aorta. Check before you hide them.">
        {`Veins and heart (suggestion): ${vessels.length}`}
      </span>
      <button type="button" aria-pressed={isHidden} onClick={() => void hideAll(vessels, !isHidden)}>
        {isHidden ? 'Show them' : 'Hide them'}
      </button>
    </div>
  );
}
