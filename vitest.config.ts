// Unit and property tests, beside the code they prove. The browser's part is in e2e/.

import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['shared/src/**/*.test.ts', 'frontend/src/**/*.test.{ts,tsx}', 'bench/**/*.test.ts'],
    setupFiles: ['vitest.setup.ts'],
    environment: 'node',
    // A worker of its own for each of 200 files would cost more than the tests.
    isolate: false,
    restoreMocks: true,
    expect: { requireAssertions: true },
  },
});
