/** Serves the built page for the tests, and a volume that comes slowly. */
import type { ServerResponse } from 'node:http';
import { defineConfig, type Plugin } from 'vite';
import page from '../vite.config.ts';
import { header, type StreamParts, VOLUME } from './streams.ts';

/** How long it takes from one slice of the slow volume to the next (ms). */
const PAUSE = 250;

const SLOW: StreamParts = { ...VOLUME, size: [64, 64, 400] };

function slowly(response: ServerResponse): void {
  const slice = new Uint8Array(SLOW.size[0] * SLOW.size[1] * 2);
  response.setHeader('Content-Type', 'application/octet-stream');
  response.write(header(SLOW));
  const timer = setInterval(() => response.write(slice), PAUSE);
  response.on('close', () => clearInterval(timer));
}

const slow: Plugin = {
  name: 'slow-volume',
  configurePreviewServer: ({ middlewares }) => {
    middlewares.use('/slow', (_, response) => slowly(response));
  },
};

// As other servers do, this one knows no address but those of its files.
export default defineConfig({ ...page, appType: 'mpa', plugins: [slow] });
