/** Starts the page: the engine, the keys, and the files that the address of the page names. */
import './style/page.css';
import './style/views.css';
import './style/panels.css';
import './style/editing.css';
import './style/measure.css';
import './style/two-scans.css';
import { render } from 'preact';
import { offerToMainPage } from './compare/companion';
import { followTool } from './edit/mode';
import { followPointer, followWhole } from './edit/previews';
import { followView, restore, stateOf } from './state/address';
import { followCine } from './state/cine';
import { start } from './state/device';
import { followLines } from './state/lines';
import { showMessage } from './state/message';
import { followPlaceTurn } from './state/place-turn';
import { followDocument } from './state/shown';
import { report } from './state/store';
import { followFacts } from './state/tidying';
import { savedSession } from './study/saving';
import { openAddresses, openPhantom } from './study/study';
import { followKeeping, guardLeaving } from './study/unsaved';
import { App } from './ui/App';
import { followGuide } from './ui/Guide';
import { listenToKeys } from './ui/keys';
import { connect, EngineClient, engine } from './worker/engine';

const asked = new URLSearchParams(window.location.search);
const isCompanion = asked.has('companion');

function addressOf(name: string): string | null {
  const meta = document.querySelector<HTMLMetaElement>(`meta[name="lumencut-${name}"]`);
  // The scan that a server names belongs to the main page.
  const address = asked.get(name) ?? (isCompanion ? null : meta?.content) ?? null;
  if (address === null) {
    return null;
  }
  const url = new URL(address, window.location.href);
  return url.origin === window.location.origin ? url.href : null;
}

async function begin(): Promise<void> {
  // Read before anything is displayed, because later the page overwrites the hash.
  const state = stateOf(window.location.hash);
  await start(asked.get('device') ?? 'auto');
  const [volume, centerlines, phantom] = [
    addressOf('volume'),
    addressOf('centerlines'),
    asked.get('phantom'),
  ];
  if (volume !== null || centerlines !== null) {
    await openAddresses(volume, centerlines);
  } else if (phantom !== null) {
    await openPhantom(phantom);
  }
  if (state && report.value && !restore(state)) {
    showMessage('The view in the address belongs to another scan, so this scan is shown from the front.');
  }
  if (!isCompanion) {
    followView();
    followGuide();
  }
}

connect(new EngineClient());
const root = document.getElementById('page');
if (root) {
  render(<App />, root);
}
listenToKeys();
guardLeaving(window);
if (isCompanion) {
  offerToMainPage();
} else {
  // Both pages share the storage of the tab, which keeps the session of the main page.
  followKeeping(sessionStorage, async () => new TextDecoder().decode(await savedSession()));
}
followEdits();
followPlaceTurn();
if (asked.has('test')) {
  // For tests only: gives access to the memory size and to requests to the engine.
  Object.assign(window, {
    lumencutTest: {
      memory: () => engine.memory(),
      ask: engine.ask.bind(engine),
    },
  });
}
void begin();

/** Starts all effects that update the page when the document changes. */
function followEdits(): void {
  followDocument();
  followLines();
  followFacts();
  followPointer();
  followWhole();
  followTool();
  followCine();
}
