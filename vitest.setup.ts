// `npm run test:long` gives each property more inputs; nothing else depends on it.

import { configureGlobal } from 'fast-check';

const runs = Number(process.env.PROPERTY_RUNS ?? 0);
if (runs > 0) configureGlobal({ numRuns: runs });
