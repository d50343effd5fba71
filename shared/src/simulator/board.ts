// The simulated board: the firmware of a profile behind a cable, and what happens to both. The only face to the outside:
// bytes in, bytes out, pulse widths, a log of the bus. Knows time and pacing, no command and no firmware.

import type { Clock } from '../clock.ts';
import { BAUD, wireMs } from '../codec/packet.ts';
import type { Frame } from '../codec/commands.ts';
import { createAgenda, type Source, createSchedule } from './agenda.ts';
import { type BusLogEntry, createLine, type Line, createSender } from './line.ts';
import type { Engine } from './engine.ts';
import { planFaults, type Fault, type Incident } from './faults.ts';
import { createFlashChip, type FlashChip } from './groupStore.ts';
import type { ProfileName } from './profileNames.ts';
import { PROFILES, type BoardProfile } from './profiles.ts';

export interface BoardOptions {
  readonly clock: Clock;
  /** Gets what the board sends, in whatever pieces. It may call the board. */
  readonly send: (bytes: Uint8Array) => void;
  /** Which board it is; `doc` where nothing is said. */
  readonly profile?: ProfileName;
  /** Servos it has, numbered from 1; as many as such a board usually has where nothing is said. */
  readonly servoCount?: number;
  /** 0: bytes take no time, a reply comes before `receive` returns. */
  readonly baud?: number;
  readonly batteryMv?: number;
  /** A hand-held pad's receiver is plugged in: some builds poll it only then (S52). */
  readonly hasPad?: boolean;
  readonly seed?: number;
  readonly faults?: readonly Fault[];
  readonly onByte?: (entry: BusLogEntry) => void;
  /** The cable came off: by the `unplug` fault or by `unplug()`. */
  readonly onUnplug?: () => void;
  /** Give the same chip to the next board and the stored groups survive. */
  readonly flash?: FlashChip;
  /**
   * How long the board has been on already. With 0 it is switched on now: it serves nothing for 0.3 s (S61) and has no
   * battery reading for 0.5 s (S59).
   */
  readonly onForMs?: number;
}

export interface Board {
  /** Bytes from the host, in whatever pieces. */
  readonly receive: (bytes: Uint8Array) => void;
  /** How many of them have not reached the board yet: a driver would hold the host back. */
  readonly waitingBytes: () => number;
  /** Where the servo is now, in the unit of the board; 0 for a pin without pulses. Throws RangeError for a servo it has not. */
  readonly pulse: (servo: number) => number;
  readonly target: (servo: number) => number;
  /** A hand turns the servo; one with torque holds against it. */
  readonly turn: (servo: number, position: number) => void;
  readonly runningSlot: () => number | null;
  /** The frame of the running group that begins within so many milliseconds, unless a stop keeps it from that; null where none is known. */
  readonly dueFrame: (withinMs: number) => Frame | null;
  /** What the count table says; 255 for all after power was lost while it was written (S40). */
  readonly frameCount: (slot: number) => number;
  /** What flash holds at that place, committed or not; null where it cannot be played. */
  readonly storedFrame: (slot: number, frameIndex: number) => Frame | null;
  readonly snapshot: () => BoardSnapshot;
  /** The cable comes off: bytes are lost in both directions, the board continues. */
  readonly unplug: () => void;
  readonly plugIn: () => void;
  /** Loses power for `offMs` (0: a reset) and starts anew; what flash holds stays. */
  readonly reboot: (offMs?: number) => void;
  /** Ends everything: no more ticks, no more replies. */
  readonly powerOff: () => void;
}

interface BoardSnapshot {
  /** Servo 1 first. */
  readonly pulses: readonly number[];
  readonly targets: readonly number[];
  readonly runningSlot: number | null;
  /** By slot. */
  readonly frameCounts: readonly number[];
}

const SLOT_COUNT = 256;
const LONG_ON_MS = 10_000;

function servoCountOf({ usualServoCount, maxServoCount }: BoardProfile, wanted = usualServoCount): number {
  if (wanted <= maxServoCount) return wanted;
  throw new RangeError(`this board has no more than ${maxServoCount} servos`);
}

export function createBoard(options: BoardOptions): Board {
  const { clock, send, baud = BAUD, onForMs = LONG_ON_MS } = options;
  const profile: BoardProfile = PROFILES[options.profile ?? 'doc'];
  const servoCount = servoCountOf(profile, options.servoCount);
  const chip = options.flash ?? createFlashChip();
  const plan = planFaults(options.faults ?? [], options.seed ?? 1);
  const startedAtMs = clock.now();
  let unplugReported = false;

  const agenda = createAgenda(clock, onForMs, () => sources, tellHost);
  const { now, turn } = agenda;
  const sender = createSender(() => line, plan);
  let onSinceMs = 0;
  let engine = switchOn(onSinceMs);
  const line: Line = createLine({
    now,
    byteMs: baud === 0 ? 0 : wireMs(1, baud),
    plan,
    arrived: (byte) => {
      if (now() >= onSinceMs) engine.takeByte(byte);
    },
    log: (direction, byte) => options.onByte?.({ atMs: startedAtMs + now() - onForMs, direction, byte }),
  });
  const happenings = createSchedule(
    plan.incidents.map(({ afterMs, incident }) => ({
      atMs: onForMs + afterMs,
      happen: () => happen(incident),
    })),
  );
  let sources = allSources();

  /** The firmware counts its time from power-up, and knows nothing before it. */
  function switchOn(atMs: number): Engine {
    const batteryMv = plan.batteryMv ?? options.batteryMv ?? 7500;
    const sinceOn = () => now() - atMs;
    return profile.createEngine({
      now: sinceOn,
      chip,
      sectorMs: plan.sectorMs,
      servoCount,
      batteryMv,
      hasPad: options.hasPad ?? false,
      ...sender,
    });
  }

  /** At one instant the loop comes before the next byte: so it does not matter how the host cuts its bytes into pieces. */
  function allSources(): readonly Source[] {
    const own = engine.sources.map(({ dueMs, fire }) => ({ dueMs: () => onSinceMs + dueMs(), fire }));
    return [happenings, ...own, line, line.outbox];
  }

  /** Flash work in progress stays half done (S40); a reply is cut. */
  function reboot(offMs: number): void {
    onSinceMs = now() + offMs;
    engine = switchOn(onSinceMs);
    sources = allSources();
  }

  function happen(incident: Incident): void {
    if (incident.kind === 'unplug') unplug();
    else if (incident.kind === 'press') engine.press(incident);
    else if (incident.kind === 'pressMode') engine.pressMode?.();
    else reboot(incident.offMs);
  }

  /** At the end of a turn, when the host may call the board again. */
  function tellHost(): void {
    const bytes = line.takeSent();
    if (bytes.length > 0) send(bytes);
    if (line.isPlugged() || unplugReported) return;
    unplugReported = true;
    options.onUnplug?.();
  }

  function unplug(): void {
    line.plug(false);
  }

  function plugIn(): void {
    unplugReported = false;
    line.plug(true);
  }

  function powerOff(): void {
    line.plug(false);
    agenda.end();
  }

  function snapshot(): BoardSnapshot {
    const servoNumbers = Array.from({ length: servoCount }, (_, index) => index + 1);
    return {
      pulses: servoNumbers.map(engine.pulse),
      targets: servoNumbers.map(engine.target),
      runningSlot: engine.runningSlot(),
      frameCounts: Array.from({ length: SLOT_COUNT }, (_, slot) => engine.frameCount(slot)),
    };
  }

  // Arms what is due without a call, for example the unplugging.
  turn(() => undefined);
  return {
    receive: (bytes) => turn(() => line.receive(bytes)),
    waitingBytes: () => turn(() => line.waitingBytes()),
    pulse: (servo) => turn(() => engine.pulse(servo)),
    target: (servo) => turn(() => engine.target(servo)),
    turn: (servo, position) => turn(() => engine.turn?.(servo, position)),
    runningSlot: () => turn(() => engine.runningSlot()),
    dueFrame: (withinMs) => turn(() => engine.dueFrame?.(withinMs) ?? null),
    frameCount: (slot) => turn(() => engine.frameCount(slot)),
    storedFrame: (slot, frameIndex) => turn(() => engine.storedFrame(slot, frameIndex)),
    snapshot: () => turn(snapshot),
    unplug: () => turn(unplug),
    plugIn: () => turn(plugIn),
    reboot: (offMs = 0) => turn(() => reboot(offMs)),
    powerOff,
  };
}
