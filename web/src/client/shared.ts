/** The single engine of the page. */
import { EngineClient } from './engine';

export const engine = new EngineClient();
