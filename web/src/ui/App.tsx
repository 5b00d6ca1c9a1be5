/** The page. */
import { report } from '../state/store';
import { DropZone } from './DropZone';
import { Help } from './Help';
import { Layout } from './Layout';
import { Messages } from './Messages';
import { StartPage } from './StartPage';
import { StatusBar } from './StatusBar';
import { Toolbar } from './Toolbar';

export function App() {
  const isOpen = report.value !== null;
  return (
    <>
      {isOpen ? <Toolbar /> : null}
      {isOpen ? <Layout /> : <StartPage />}
      <Messages />
      <DropZone />
      <StatusBar />
      <Help />
    </>
  );
}
