import { defineConfig } from 'vitest/config';

/** Unit tests; browser tests are Playwright's, in e2e. */
export default defineConfig({
  test: {
    include: ['tests/**/*.test.ts'],
    globalSetup: 'tests/needs.ts',
    testTimeout: 300_000,
    pool: 'threads',
  },
});
