import { report } from '../state/store';
import { ComparisonBar } from './ComparisonBar';
import { ComparisonPane } from './ComparisonPane';
import { DropZone } from './DropZone';
import { Guide } from './Guide';
import { Help } from './Help';
import { Layout } from './Layout';
import { Messages } from './Messages';
import { OtherScan, ScanNames } from './OtherScan';
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
      <ScanNames />
      <div class="studies">
        {isOpen ? <Work /> : <StartPage />}
        <OtherScan />
      </div>
      <ComparisonPane />
      <ComparisonBar />
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
