import { defineConfig } from 'vitest/config';

/** The tests of pure logic; those that need a browser are Playwright's, under e2e. */
export default defineConfig({ test: { include: ['tests/**/*.test.ts'], testTimeout: 5000 } });
