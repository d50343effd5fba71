// The names that a program uses: of servos, by the robot on the board, and of groups, by what the gateway knows of the slots. Knows
// positions and units; nothing of motion.

import timings from '../../protocol/timings.json' with { type: 'json' };
import { GatewayError } from './errors.ts';
import type { Gateway } from './gateway.ts';
import type { FrameBody } from './http.generated.ts';
import { now } from './motions.ts';
import { UNITS, type Frames, type Positions, type Units } from './options.ts';
import { numberOf, positionOf, servosIn, snapshotOf, type Servo } from './values.ts';

const REMEMBERED_S = timings.program.namesMs / 1000;
const isNumber = (servo: string): boolean => /^\d+$/.test(servo);

interface Described {
  readonly atS: number;
  readonly known: readonly Servo[];
  readonly board: string;
}

export class Names {
  readonly #gateway: Gateway;
  #described: Described | null = null;

  constructor(gateway: Gateway) {
    this.#gateway = gateway;
  }

  async slotOf(group: string): Promise<number> {
    const { groups } = snapshotOf(await this.#gateway.welcome());
    const found = Object.keys(groups).filter((slot) => groups[Number(slot)] === group);
    const [slot] = found;
    if (slot !== undefined && found.length === 1) return Number(slot);
    const known = [...new Set(Object.values(groups))].filter(Boolean).sort();
    const names = known.length > 0 ? known.join(', ') : 'no names';
    const problem = found.length > 1 ? 'Several slots hold' : 'No slot is known to hold';
    throw new GatewayError(
      'notFound',
      `${problem} ${group}. Known groups: ${names}. Use a slot's number, or download.`,
    );
  }

  /** By servo number, in the board's unit. */
  async positions(positions: Positions, units: Units, signal?: AbortSignal): Promise<Record<string, number>> {
    if (!UNITS.includes(units))
      throw new GatewayError('outOfRange', `units is ${units as string}, allowed: ${UNITS.join(', ')}`);
    const entries = Object.entries(positions);
    if (units === 'board' && entries.every(([servo]) => isNumber(servo))) return Object.fromEntries(entries);
    let { known, board } = await this.described({ signal });
    const isKnown = (servo: string): boolean =>
      isNumber(servo) || known.some(({ name }) => name.toLowerCase() === servo.toLowerCase());
    if (!entries.every(([servo]) => isKnown(servo)))
      ({ known, board } = await this.described({ isNew: true, signal }));
    const wanted = new Map<number, number>();
    for (const [servo, at] of entries) {
      const number = numberOf(known, servo);
      if (wanted.has(number))
        throw new GatewayError('outOfRange', `Servo ${number} is named twice, the second time as ${servo}.`);
      wanted.set(number, units === 'deg' ? positionOf(known, board, number, at) : at);
    }
    return Object.fromEntries(wanted);
  }

  async frames(frames: Frames, units: Units, signal?: AbortSignal): Promise<FrameBody[]> {
    const bodies: FrameBody[] = [];
    for (const [seconds, positions] of frames)
      bodies.push({
        durationMs: Math.round(seconds * 1000),
        positions: await this.positions(positions, units, signal),
      });
    return bodies;
  }

  /** As the robot on the board was a few seconds ago at most: its home may have been changed since. */
  async described(options: { isNew?: boolean; signal?: AbortSignal | undefined }): Promise<Described> {
    const { isNew = false, signal } = options;
    if (this.#described && !isNew && now() - this.#described.atS < REMEMBERED_S) return this.#described;
    const { robot, board } = await this.#gateway.welcome(signal);
    const known = robot === null ? [] : servosIn(await this.#documentOf(robot.id, signal));
    this.#described = { atS: now(), known, board };
    return this.#described;
  }

  async #documentOf(robot: string, signal: AbortSignal | undefined): Promise<string> {
    const given = { values: { document: robot } };
    const options = { isSafe: true, signal };
    return (await this.#gateway.call('get', '/api/library/{document}', given, options)).text;
  }
}
