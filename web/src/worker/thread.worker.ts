/** One of the threads that compute in the engine's memory. */
import { joinModule, type Shared } from '../core/module';

self.onmessage = (message: MessageEvent<Shared>) => {
  self.postMessage('ready');
  joinModule(message.data);
};
