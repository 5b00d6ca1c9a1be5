/** Serves the built page for the tests, and a slow volume. */
import type { ServerResponse } from 'node:http';
import { defineConfig, type Plugin } from 'vite';
import page from '../vite.config.ts';
import { header, type StreamParts, VOLUME } from './streams.ts';

/** The server waits this long before each slice of the slow volume (ms). */
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

// Like other servers, it answers 404 for paths without a file.
export default defineConfig({ ...page, appType: 'mpa', plugins: [slow] });
