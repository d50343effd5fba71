// `npm run test:long` gives each property more inputs, and the time for them; nothing else depends on it.

import { configureGlobal } from 'fast-check';
import { vi } from 'vitest';

const runs = Number(process.env.PROPERTY_RUNS ?? 0);
if (runs > 0) {
  configureGlobal({ numRuns: runs });
  vi.setConfig({ testTimeout: 300_000 });
}
