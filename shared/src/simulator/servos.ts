// The motion engine: one plan for all channels, re-made at the tick after any accepted target (S23-S27). Counts ticks and
// knows no clock; when a tick comes is mainLoop.ts.

export interface Servos {
  /** Takes one target. A channel the board has not, or a position out of range, is dropped silently (S23, S24). */
  readonly accept: (servo: number, positionUs: number, durationMs: number) => void;
  readonly tick: () => void;
  /** Whether the next tick would change anything. */
  readonly moving: () => boolean;
  /** Pulse width on the channel now, in µs. Throws RangeError for a channel the board has not. */
  readonly pulse: (servo: number) => number;
  readonly target: (servo: number) => number;
}

const CENTRE_US = 1500;
const MIN_US = 500;
const MAX_US = 2500;
const MIN_MOVE_MS = 20;
const MAX_MOVE_MS = 30_000;
export const TICK_MS = 20;
/** Channels 0..7 exist on every board, with or without a pin (S23). */
const LEAST_CHANNELS = 8;

export function createServos(servoCount: number): Servos {
  const channels = Math.max(LEAST_CHANNELS, servoCount + 1);
  // No ramp at power-up: all pulses are there at once (S61).
  const pulses = new Array<number>(channels).fill(CENTRE_US);
  const targets = [...pulses];
  let starts = [...pulses];
  let durationMs = MIN_MOVE_MS;
  let changed = false;
  let tickCount = 0;
  let ticksDone = 0;

  function accept(servo: number, positionUs: number, requestedMs: number): void {
    if (servo >= channels || positionUs < MIN_US || positionUs > MAX_US) return;
    targets[servo] = positionUs;
    durationMs = Math.min(Math.max(requestedMs, MIN_MOVE_MS), MAX_MOVE_MS);
    changed = true;
  }

  function plan(): void {
    changed = false;
    starts = [...pulses];
    tickCount = Math.trunc(durationMs / TICK_MS);
    ticksDone = 0;
  }

  function tick(): void {
    if (changed) plan();
    if (ticksDone === tickCount) return;
    ticksDone += 1;
    for (const [channel, target] of targets.entries()) {
      const start = starts[channel] ?? target;
      // In single precision, as the firmware computes (S27).
      const perTick = Math.fround((start - target) / tickCount);
      pulses[channel] = target + Math.trunc(Math.fround(perTick * (tickCount - ticksDone)));
    }
  }

  function channelOf(values: readonly number[], servo: number): number {
    const value = values[servo];
    if (value === undefined)
      throw new RangeError(`servo ${servo} is not one of the channels 0..${channels - 1}`);
    return value;
  }

  return {
    accept,
    tick,
    moving: () => changed || ticksDone < tickCount,
    pulse: (servo) => channelOf(pulses, servo),
    target: (servo) => channelOf(targets, servo),
  };
}
