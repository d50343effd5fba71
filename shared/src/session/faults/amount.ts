// How much the fault tests try, and how a failing case names itself. Knows the test runner's environment; no fault.

/** Shared code is compiled without a platform; the test runner has one. */
const { process: runner } = globalThis as { process?: { env: Readonly<Record<string, string | undefined>> } };
const env = runner?.env ?? {};

/** Set by hand to repeat one failing case. */
const ONLY_SEED = env.FAULT_SEED;
/** `npm run test:long` sets it for every property; faults take their largest amounts then, as does a repeated case. */
export const isLong = Number(env.PROPERTY_RUNS ?? 0) > 0 || ONLY_SEED !== undefined;

/** The seeds to try: `count` of them, ten times that in a long run, or the one asked for. */
export function seeds(count: number): readonly number[] {
  if (ONLY_SEED !== undefined) return [Number(ONLY_SEED)];
  return Array.from({ length: isLong ? count * 10 : count }, (_, index) => index + 1);
}

/** Every case of a table by its number, from 0, or the one asked for. */
export function cases(count: number): readonly number[] {
  if (ONLY_SEED !== undefined) return [Number(ONLY_SEED)].filter((number) => number < count);
  return Array.from({ length: count }, (_, index) => index);
}

/** Runs `attempt` and puts the way to repeat it in front of whatever it throws. */
export async function named(
  file: string,
  seed: number,
  what: string,
  attempt: () => Promise<void>,
): Promise<void> {
  try {
    await attempt();
  } catch (error) {
    const replay = `FAULT_SEED=${seed} npx vitest run shared/src/session/faults/${file}`;
    throw new Error(`${what}, seed ${seed}\nreplay: ${replay}\n${String(error)}`, { cause: error });
  }
}
