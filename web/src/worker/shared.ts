/** The only connection to the engine, used by the whole page. */
import { EngineClient } from './client';

export const engine = new EngineClient();
