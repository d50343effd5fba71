// How many cases properties and fault tables try, how a failing one names itself, and numbers for them. Knows the test runner's environment.

import * as fc from 'fast-check';

/** Shared code is compiled without a platform; the test runner has one. */
const { process: runner } = globalThis as { process?: { env: Readonly<Record<string, string | undefined>> } };
const env = runner?.env ?? {};

/** Set by hand to repeat one failing case. */
const ONLY_SEED = env.FAULT_SEED;
/** What a property tries by default. `npm run test:all -- --long` sets PROPERTY_RUNS to ten times that. */
const USUAL_RUNS = 100;
export const TIMES = Math.max(1, Math.floor(Number(env.PROPERTY_RUNS ?? 0) / USUAL_RUNS));
export const IS_EXHAUSTIVE = env.EXHAUSTIVE === '1' || TIMES > 1;
/** What `npm test` tries of a longer table: enough to see each kind of fault, evenly spread. */
const SAMPLE = 50;

/** The seeds to try, below `count`: `sample` of them, or all, TIMES as many in a long run, or the requested one. */
export function seeds(count: number, sample = SAMPLE): readonly number[] {
  if (ONLY_SEED !== undefined) return [Number(ONLY_SEED)];
  const all = count * TIMES;
  const tried = IS_EXHAUSTIVE ? all : Math.min(all, sample);
  return Array.from({ length: tried }, (_, index) => Math.floor((index * all) / tried));
}

/** Where a table of `size` cases has several rounds: round 0 is the table itself, each later one varies it. */
export function caseOf(seed: number, size: number): { readonly at: number; readonly round: number } {
  return { at: seed % size, round: Math.floor(seed / size) };
}

/** The command that runs these seeds of a file again. */
export function replay(file: string, seed: number): string {
  return `FAULT_SEED=${seed} npx vitest run shared/src/robot/faults/${file}`;
}

/** Runs `attempt` and puts the way to repeat it in front of whatever it throws. */
export async function named(
  file: string,
  seed: number,
  what: string,
  attempt: () => Promise<void> | void,
): Promise<void> {
  try {
    await attempt();
  } catch (error) {
    const text = `${what}, seed ${seed}\nreplay: ${replay(file, seed)}\n${String(error)}`;
    throw new Error(text, { cause: error });
  }
}

const STEPS = 10_000;

/**
 * Numbers that are as likely anywhere between two others: fast-check's own doubles are as likely at each size, so that between 0 and 1
 * nearly all of them are next to 0.
 */
export function evenly(min: number, max: number): fc.Arbitrary<number> {
  return fc.integer({ min: 0, max: STEPS }).map((step) => min + ((max - min) * step) / STEPS);
}
