// Properties: `npm test` tries the same inputs each time, so that it fails by a change and by nothing else. A long run tries new
// ones, ten times as many, and has the time for them; nothing else depends on it.

import { configureGlobal } from 'fast-check';
import { afterAll, vi } from 'vitest';

const SEED = 1;
const runs = Number(process.env.PROPERTY_RUNS ?? 0);
configureGlobal(runs > 0 ? { numRuns: runs } : { seed: SEED });
if (runs > 0) vi.setConfig({ testTimeout: 300_000 });

// Test files share a worker.
afterAll(() => {
  vi.useRealTimers();
});
