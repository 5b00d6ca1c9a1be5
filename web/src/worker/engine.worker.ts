/** The worker that holds the study and computes its pictures. */
import { expose } from 'comlink';
import { EngineHost } from './host';

expose(new EngineHost());
