/** What the page asks its worker for to save a session and to go on with it. */
import { proxyMarker, transfer } from 'comlink';
import type { Engine } from '../core/module';
import type { SessionContent } from '../core/session-file';

/** Runs work with the engine, after all that was asked for before. */
type Run = <T>(work: (engine: Engine) => T) => Promise<T>;

export class SessionHost {
  /** The page calls it where it is. */
  readonly [proxyMarker] = true;

  constructor(private readonly run: Run) {}

  write(content: SessionContent): Promise<Uint8Array<ArrayBuffer>> {
    return this.run((engine) => {
      const bytes = engine.write_session(JSON.stringify(content)) as Uint8Array<ArrayBuffer>;
      return transfer(bytes, [bytes.buffer]);
    });
  }

  read(bytes: Uint8Array, name: string): Promise<SessionContent> {
    return this.run((engine) => JSON.parse(engine.read_session(bytes, name)));
  }
}
