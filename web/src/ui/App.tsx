/** The root component of the page. */
import { report } from '../state/store';
import { DropZone } from './DropZone';
import { Guide } from './Guide';
import { Help } from './Help';
import { Layout } from './Layout';
import { Messages } from './Messages';
import { ShownQuestion } from './ShownQuestion';
import { StartPage } from './StartPage';
import { StatusBar } from './StatusBar';
import { Toolbar } from './Toolbar';
import { TraceBar } from './TraceBar';
import { VesselList } from './VesselList';

export function App() {
  const isOpen = report.value !== null;
  return (
    <>
      {isOpen ? <Toolbar /> : null}
      {isOpen ? <Work /> : <StartPage />}
      <ShownQuestion />
      <Messages />
      <DropZone />
      <StatusBar />
      <Help />
    </>
  );
}

function Work() {
  return (
    <div class="work">
      <VesselList />
      <div class="views">
        <Guide />
        <TraceBar />
        <Layout />
      </div>
    </div>
  );
}
