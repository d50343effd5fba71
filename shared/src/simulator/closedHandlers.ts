// The commands that only the closed boards have (boards.md 2.3): speed of a group, release of servos, their positions.
// Reads the mailbox's slot in place, as dispatch.ts does.

import { PARAMS_AT, type Handlers, type Reply } from './dispatch.ts';
import type { OwnTimeServos } from './ownTimeServos.ts';
import type { Speeds } from './speeds.ts';
import { readUint16, uint16 } from './storedFrame.ts';
import type { Work } from './work.ts';

const SET_SPEED = 11;
const RELEASE = 20;
const READ_POSITIONS = 21;
/** Asking six servos takes up to 450 ms (X7). */
const READ_POSITION_MS = 75;

export function closedHandlers(slot: Uint8Array, speeds: Speeds): Handlers {
  function* setSpeed(): Work {
    yield* [];
    speeds.set(slot[PARAMS_AT] ?? 0, readUint16(slot, PARAMS_AT + 1));
  }

  return new Map([[SET_SPEED, setSpeed]]);
}

export interface TorqueParts {
  readonly slot: Uint8Array;
  readonly servos: OwnTimeServos;
  readonly servoCount: number;
  readonly reply: Reply;
}

export function torqueHandlers({ slot, servos, servoCount, reply }: TorqueParts): Handlers {
  /** Those of the packet's servos that are there. */
  function named(): number[] {
    const listAt = PARAMS_AT + 1;
    const list = slot.slice(listAt, listAt + (slot[PARAMS_AT] ?? 0));
    return [...list].filter((servo) => servo >= 1 && servo <= servoCount);
  }

  /** The simulated arm has no weight: it stays where it is until a hand turns it. */
  function* release(): Work {
    yield* [];
    named().forEach(servos.release);
  }

  function* readPositions(): Work {
    const present = named();
    if (present.length === 0) return;
    yield present.length * READ_POSITION_MS;
    const entries = present.flatMap((servo) => [servo, ...uint16(servos.pulse(servo))]);
    yield* reply(READ_POSITIONS, [present.length, ...entries]);
  }

  return new Map([
    [RELEASE, release],
    [READ_POSITIONS, readPositions],
  ]);
}
