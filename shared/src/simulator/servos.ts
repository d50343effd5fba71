// The motion engines: one plan for all channels, re-made at the tick after any accepted target (S23-S27), and servos that each take their
// own time. Count ticks and know no clock; when a tick comes is mainLoop.ts.

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

export interface OwnTimeServos extends Servos {
  /** Stays where it is from the next tick on, until the next target. */
  readonly freeze: (servo: number) => void;
  /** Takes its torque off until the next target: it stays where it is unless a hand turns it. */
  readonly release: (servo: number) => void;
  /** A hand turns it; one with torque holds against it. */
  readonly turn: (servo: number, position: number) => void;
}

interface ServoTraits {
  readonly tickMs: number;
  /** The target the board makes of a position; null where it takes none. */
  readonly targetOf: (servo: number, position: number) => number | null;
  /** Where a servo is at power-up; null where it gets no pulse until its first target, and then jumps (X4). */
  readonly startOf: (servo: number) => number | null;
  /** This number means all servos. */
  readonly broadcast: number | null;
}

interface Channel {
  position: number | null;
  start: number;
  target: number;
  ticks: number;
  ticksLeft: number;
  isReleased: boolean;
}

const SHORTEST_MOVE_MS = 20;
const LONGEST_MOVE_MS = 30_000;
/** What a pin without pulses shows. */
const NO_PULSE = 0;

export function createOwnTimeServos(servoCount: number, traits: ServoTraits): OwnTimeServos {
  const channels = new Map<number, Channel>();
  for (let servo = 1; servo <= servoCount; servo += 1) {
    const position = traits.startOf(servo);
    channels.set(servo, {
      position,
      start: position ?? NO_PULSE,
      target: position ?? NO_PULSE,
      ticks: 0,
      ticksLeft: 0,
      isReleased: false,
    });
  }

  function aim(servo: number, position: number, requestedMs: number): void {
    const channel = channels.get(servo);
    const target = traits.targetOf(servo, position);
    if (!channel || target === null) return;
    const durationMs = Math.min(Math.max(requestedMs, SHORTEST_MOVE_MS), LONGEST_MOVE_MS);
    channel.isReleased = false;
    channel.target = target;
    channel.position ??= target;
    channel.start = channel.position;
    channel.ticks = Math.trunc(durationMs / traits.tickMs);
    channel.ticksLeft = channel.ticks;
  }

  function accept(servo: number, position: number, durationMs: number): void {
    const servos = servo === traits.broadcast ? [...channels.keys()] : [servo];
    for (const each of servos) aim(each, position, durationMs);
  }

  function step(channel: Channel): void {
    if (channel.ticksLeft === 0) return;
    channel.ticksLeft -= 1;
    const { start, target, ticks, ticksLeft } = channel;
    channel.position = target + Math.trunc(((start - target) * ticksLeft) / ticks);
  }

  function freeze(servo: number): void {
    const channel = channels.get(servo);
    if (!channel) return;
    channel.target = channel.position ?? NO_PULSE;
    channel.ticksLeft = 0;
  }

  function release(servo: number): void {
    freeze(servo);
    const channel = channels.get(servo);
    if (channel) channel.isReleased = true;
  }

  function turn(servo: number, position: number): void {
    const channel = channelOf(servo);
    const to = traits.targetOf(servo, position);
    if (!channel.isReleased || to === null) return;
    channel.position = to;
    channel.target = to;
  }

  function channelOf(servo: number): Channel {
    const channel = channels.get(servo);
    if (channel) return channel;
    throw new RangeError(`servo ${servo} is not one of the servos 1..${servoCount}`);
  }

  return {
    accept,
    tick: () => channels.forEach(step),
    moving: () => [...channels.values()].some(({ ticksLeft }) => ticksLeft > 0),
    freeze,
    release,
    turn,
    pulse: (servo) => channelOf(servo).position ?? NO_PULSE,
    target: (servo) => channelOf(servo).target,
  };
}
