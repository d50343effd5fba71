// `Servodeck`: a robot at a gateway, for programs in TypeScript and JavaScript. The twin of backend/servodeck/client: the same methods,
// options, units and errors (twins.test.ts compares them). Knows which requests each method makes; not how a motion is waited for.

/// <reference lib="esnext.disposable" preserve="true" />

import timings from '../../protocol/timings.json' with { type: 'json' };
import { GatewayError } from './errors.ts';
import { gatewayAt, type Event, type Gateway } from './gateway.ts';
import type { JobState, Status, UnheldServos } from './http.generated.ts';
import { endedWith, LOOK_S, Motions, patienceOf, rest, SETTLED_S, type Patience } from './motions.ts';
import { Names } from './names.ts';
import type {
  DownloadOptions,
  Frames,
  MoveOptions,
  Options,
  Outcome,
  PlayOptions,
  PoseOptions,
  Positions,
  RunOptions,
} from './options.ts';
import { snapshotOf, type Servo, type Snapshot } from './values.ts';

export { GatewayError, TimedOutError, UnreachableError } from './errors.ts';
export { degreesAt, positionAt } from './values.ts';
export type { Event, Frames, JobState, Options, Outcome, Positions, Servo, Snapshot, Status };

const POSE_S = timings.program.moveMs / 1000;
const START_S = timings.program.firstMoveMs / 1000;
const MOST_SERVOS = 32;
const TAKEN_S = timings.program.afterEndMs / 1000;

/** At the end of `await using`, what this program has in motion is stopped and its lease released. */
export class Servodeck {
  readonly #gateway: Gateway;
  readonly #take: boolean;
  readonly #closed = new AbortController();
  readonly #motions: Motions;
  readonly #names: Names;

  /** `where` is the gateway's address. Throws a TypeError where it is none. */
  constructor(where = 'http://127.0.0.1:8300', { token = '', take = false, timeout = 10 }: Options = {}) {
    this.#gateway = gatewayAt(where, token, timeout);
    this.#motions = new Motions(this.#gateway, this.#closed.signal);
    this.#names = new Names(this.#gateway);
    this.#take = take;
  }

  async [Symbol.asyncDispose](): Promise<void> {
    await this.close();
  }

  /** Stops what this program has in motion, and releases its lease. May be called twice. */
  async close(): Promise<void> {
    this.#closed.abort();
    await this.#motions.ended();
    await this.#motions.release();
  }

  // Motion

  /** Moves servos together: `{ Base: 30 }`. The first move of a servo takes at least 1.5 s. */
  async move(
    positions: Positions,
    { units, seconds = POSE_S, wait = true, timeout, signal, ...unknown }: MoveOptions,
  ): Promise<void> {
    this.#judgeOpen();
    judgeOptions(unknown);
    const patience = patienceOf({ wait, timeout, signal });
    const wanted = await this.#names.positions(positions, units, signal);
    const timeMs = Math.round(seconds * 1000);
    const body = { timeMs, positions: wanted, take: this.#take, beats: true };
    const moreS = START_S * Object.keys(wanted).length;
    const { overInMs } = await this.#motions.begin('post', '/api/move', { body }, { moreS, ...patience });
    await this.#moves(overInMs / 1000, wait, patience);
  }

  /** Moves to a pose of the robot, by name or number; "home" is number 0. */
  async pose(
    pose: string | number,
    { seconds = POSE_S, wait = true, timeout, signal, ...unknown }: PoseOptions = {},
  ): Promise<void> {
    this.#judgeOpen();
    judgeOptions(unknown);
    const patience = patienceOf({ wait, timeout, signal });
    const body = { timeMs: Math.round(seconds * 1000), take: this.#take, beats: true };
    const given = { values: { pose: String(pose) }, body };
    const moreS = START_S * MOST_SERVOS;
    const { overInMs } = await this.#motions.begin('post', '/api/poses/{pose}/apply', given, {
      moreS,
      ...patience,
    });
    await this.#moves(overInMs / 1000, wait, patience);
  }

  async #moves(overInS: number, wait: boolean, patience: Patience): Promise<void> {
    this.#motions.begun(overInS);
    if (wait) await this.#motions.moved(overInS, patience);
    else this.#motions.beat();
  }

  /** Runs a group of the board, by its name or slot. */
  async run(
    group: string | number,
    { times = 1, wait = true, timeout, alone, anyway = false, signal, ...unknown }: RunOptions = {},
  ): Promise<Outcome> {
    this.#judgeOpen();
    judgeOptions(unknown);
    judgeEnd(times, wait, timeout);
    const patience = patienceOf({ wait, timeout, signal });
    const slot = typeof group === 'number' ? group : await this.#names.slotOf(group);
    const given = { values: { slot }, body: { times, anyway, take: this.#take, ...continuing(alone) } };
    const { outcome } = await this.#motions.begin('post', '/api/slots/{slot}/run', given, {
      moreS: TAKEN_S,
      ...patience,
    });
    if (wait) await this.#motions.ran(slot, patience);
    else if (alone === undefined) this.#motions.beat();
    return outcome;
  }

  /** Plays frames by the gateway's clock: `[[0.5, { Base: 30 }], …]`. */
  async play(
    frames: Frames,
    {
      units,
      times = 1,
      loopFrom = 0,
      wait = true,
      timeout,
      alone,
      anyway = false,
      signal,
      ...unknown
    }: PlayOptions,
  ): Promise<void> {
    this.#judgeOpen();
    judgeOptions(unknown);
    judgeEnd(times, wait, timeout);
    const patience = patienceOf({ wait, timeout, signal });
    const bodies = await this.#names.frames(frames, units, signal);
    const body = { frames: bodies, times, loopFrom, anyway, take: this.#take, ...continuing(alone) };
    const { id } = await this.#motions.begin('post', '/api/play', { body }, patience);
    if (wait) await this.#motions.played(id, patience);
    else if (alone === undefined) this.#motions.beat();
  }

  /** Stores a group in a slot of the board; returns the gateway's job. Not waited for, it continues at the gateway. */
  async download(
    slot: number,
    frames: Frames,
    { units, name = '', replaces, wait = true, timeout, signal, ...unknown }: DownloadOptions,
  ): Promise<JobState> {
    this.#judgeOpen();
    judgeOptions(unknown);
    const patience = patienceOf({ wait, timeout, signal });
    const bodies = await this.#names.frames(frames, units, signal);
    const group = { slot, name, version: '', frames: bodies, ...(replaces !== undefined && { replaces }) };
    const body = { groups: [group], take: this.#take };
    let job: JobState = await this.#motions.begin(
      'post',
      '/api/download',
      { body },
      { moreS: SETTLED_S, ...patience },
    );
    const given = { values: { job: job.id } };
    const lateWords = 'The download did not end in time, so it was cancelled.';
    try {
      while (wait && job.status === 'running') {
        await rest(LOOK_S, patience, lateWords);
        job = await this.#gateway.call('get', '/api/jobs/{job}', given, { isSafe: true, signal });
      }
    } catch (error) {
      await this.#gateway.call('delete', '/api/jobs/{job}', given, { isSafe: true });
      throw error;
    }
    if (job.status === 'failed' || job.status === 'cancelled') throw endedWith(job);
    return job;
  }

  /** Erases every slot of the board, for good. Owners only. */
  async erase(): Promise<void> {
    this.#judgeOpen();
    await this.#motions.erase(this.#take);
  }

  // The right to drive

  /**
   * Stops the robot, also while another client drives, and refuses motion until `resume`. Returns the motion that could not be held,
   * `servos` and `forMs`; null: all is held.
   */
  async stop(): Promise<UnheldServos | null> {
    this.#judgeOpen();
    return (await this.#gateway.call('post', '/api/stop', {}, { isSafe: true })).unheld;
  }

  /** Allows motion again. Moves nothing. Look at the robot first. */
  async resume(): Promise<void> {
    this.#judgeOpen();
    await this.#gateway.call('post', '/api/resume', {});
  }

  /** Whether this program drives now; otherwise the driver has 5 s to refuse. Motion does it by itself. */
  async requestLease(): Promise<boolean> {
    this.#judgeOpen();
    return (await this.#motions.lease(this.#take ? 'take' : 'request')).drives;
  }

  /** Stops what this program has in motion, without a latch, and releases its lease. */
  async release(): Promise<void> {
    this.#judgeOpen();
    await this.#motions.release();
  }

  // Looking

  /** The state of gateway, board and motion. */
  async snapshot(): Promise<Snapshot> {
    this.#judgeOpen();
    return snapshotOf(await this.#gateway.welcome());
  }

  /** As `GET /api/status` has it. */
  async status(): Promise<Status> {
    this.#judgeOpen();
    return this.#gateway.call('get', '/api/status', {}, { isSafe: true });
  }

  /** In millivolts: queries the board now. */
  async battery(): Promise<number> {
    this.#judgeOpen();
    return (await this.#gateway.call('get', '/api/battery', {}, { isSafe: true })).batteryMv;
  }

  /** The names of the robot's poses, by number. */
  async poses(): Promise<Readonly<Record<number, string>>> {
    this.#judgeOpen();
    const { poses } = await this.#gateway.call('get', '/api/poses', {}, { isSafe: true });
    return Object.fromEntries(poses.map(({ id, name }) => [id, name]));
  }

  /** Those that the robot on the board describes. */
  async servos(): Promise<readonly Servo[]> {
    this.#judgeOpen();
    return (await this.#names.described({ isNew: true })).known;
  }

  /**
   * Every change as an event, for so many seconds; the first one, `welcome`, has the whole state. A lost stream is opened again: then
   * `gap` and `welcome` come.
   */
  async *events({ seconds, signal }: { seconds?: number; signal?: AbortSignal } = {}): AsyncGenerator<
    Event,
    void
  > {
    this.#judgeOpen();
    const limits = [
      this.#closed.signal,
      signal,
      seconds === undefined ? undefined : AbortSignal.timeout(Math.round(seconds * 1000)),
    ];
    yield* this.#gateway.events(AbortSignal.any(limits.filter((one) => one !== undefined)));
  }

  /** Throws a GatewayError. */
  #judgeOpen(): void {
    if (this.#closed.signal.aborted)
      throw new GatewayError('closed', 'This robot was closed: its program makes a new one.');
  }
}

/** A program in JavaScript may misspell one: it would go on with what was not meant. */
function judgeOptions(unknown: object): void {
  const [name] = Object.keys(unknown);
  if (name !== undefined) throw new GatewayError('outOfRange', `${name} is no option of this method.`);
}

function judgeEnd(times: number, wait: boolean, timeout: number | undefined): void {
  if (wait && times === 0 && timeout === undefined)
    throw new RangeError('times: 0 repeats until stopped: add a timeout, or wait: false.');
}

const continuing = (alone: number | undefined): { continueForMs?: number } =>
  alone === undefined ? {} : { continueForMs: Math.round(alone * 1000) };
