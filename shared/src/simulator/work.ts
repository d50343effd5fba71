// Work that takes the board's processor time: yields how many milliseconds the main loop is blocked, then goes on. Bytes
// keep arriving meanwhile, because an interrupt takes them (S41).

export type Work = Generator<number, void, undefined>;

/** Nothing to do, in no time. */
export function* noWork(): Work {
  yield* [];
}
