// How much the fault tests try, and how a failing case names itself. Knows the test runner's environment; no fault.

/** Shared code is compiled without a platform; the test runner has one. */
const { process: runner } = globalThis as { process?: { env: Readonly<Record<string, string | undefined>> } };
const env = runner?.env ?? {};

/** Set by hand to repeat one failing case. */
const ONLY_SEED = env.FAULT_SEED;
/** `npm run test:long` sets it for every property; ten times the cases are tried then. */
export const TIMES = Number(env.PROPERTY_RUNS ?? 0) > 0 ? 10 : 1;

/** The seeds to try, from 0: `count` of them, ten times that in a long run, or the one asked for. */
export function seeds(count: number): readonly number[] {
  if (ONLY_SEED !== undefined) return [Number(ONLY_SEED)];
  return Array.from({ length: count * TIMES }, (_, index) => index);
}

/** Where a table of `size` cases has several rounds: round 0 is the table itself, each later one varies it. */
export function caseOf(seed: number, size: number): { readonly at: number; readonly round: number } {
  return { at: seed % size, round: Math.floor(seed / size) };
}

/** The command that runs these seeds of a file again. */
export function replay(file: string, seed: number): string {
  return `FAULT_SEED=${seed} npx vitest run shared/src/session/faults/${file}`;
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
