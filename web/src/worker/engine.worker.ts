/** Entry of all workers. One holds the study and renders; those named `thread` compute in its memory. */
import { expose } from 'comlink';
import { joinModule, type Shared } from '../core/module';
import { EngineHost, THREAD } from './host';

if (self.name === THREAD) {
  self.onmessage = (message: MessageEvent<Shared>) => {
    self.postMessage('ready');
    joinModule(message.data);
  };
} else {
  expose(new EngineHost());
}
