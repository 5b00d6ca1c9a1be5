/** Session files as the page uses them: calls to the worker. */
import type { Remote } from 'comlink';
import type { SessionHost } from '../worker/session-host';
import type { SessionContent, Sessions } from './session-file';

export class SessionClient implements Sessions {
  constructor(
    private readonly host: Remote<SessionHost>,
    /** Hears an answer that the user waits for. */
    private readonly first: <T>(answer: Promise<T>) => Promise<T>,
  ) {}

  write(content: SessionContent): Promise<Uint8Array<ArrayBuffer>> {
    return this.first(this.host.write(content));
  }

  read(bytes: Uint8Array, name: string): Promise<SessionContent> {
    return this.first(this.host.read(bytes, name));
  }
}
