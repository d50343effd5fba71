// Unit and property tests, beside the code they prove.

import { defineConfig } from 'vitest/config';
import { words } from './scripts/words.mjs';

export default defineConfig({
  plugins: [words()],
  test: {
    restoreMocks: true,
    expect: { requireAssertions: true },
    include: [
      'shared/src/**/*.test.ts',
      'scripts/**/*.test.ts',
      'frontend/src/**/*.test.{ts,tsx}',
      'bench/**/*.test.ts',
    ],
    setupFiles: ['vitest.setup.ts'],
    environment: 'node',
    // Ends what hangs: nothing here waits for a real clock, and `npm test` gives these what processor time others leave.
    testTimeout: 60_000,
    // A worker of its own for each of 200 files would cost more than the tests.
    isolate: false,
  },
});
