// The motion that a program has begun: how its end is waited for, heartbeats meanwhile, and its end by a release. Knows the routes of
// motion and lease; no servo, no name and no unit.

import timings from '../../protocol/timings.json' with { type: 'json' };
import { GatewayError, TimedOutError, UnreachableError } from './errors.ts';
import { pause, type Gateway } from './gateway.ts';
import type { LeaseState, LeaseWish, Status } from './http.generated.ts';
import type { Answer, Given, Path, Verb } from './request.ts';

/** The gateway stops motion two seconds after the last one. */
const BEAT_S = timings.lease.silentMs / 2000;
export const LOOK_S = timings.program.lookMs / 1000;
const UNKNOWN_END_S = timings.program.unknownEndMs / 1000;
const AFTER_END_S = timings.program.afterEndMs / 1000;
const LATE_S = timings.program.lateMs / 1000;
const IDENTIFIED_S = timings.program.identifiedMs / 1000;

/** At that time, by `now`, and whenever the signal is aborted, the motion that is waited for is stopped. */
export interface Patience {
  readonly untilS: number;
  readonly signal: AbortSignal | undefined;
}

interface Limits {
  readonly wait: boolean;
  readonly timeout: number | undefined;
  readonly signal: AbortSignal | undefined;
}

/** From now on; without `wait` there is nothing to be impatient of. */
export function patienceOf({ wait, timeout, signal }: Limits): Patience {
  return { untilS: wait && timeout !== undefined ? now() + timeout : Infinity, signal };
}

/** Flash takes its time. */
const ERASE_S = timings.erase.timeoutMs / 1000;
/** A download and an erase also wait until the longest frame that others can have begun has ended. */
export const SETTLED_S = timings.move.longestMs / 1000;

export const now = (): number => performance.now() / 1000;

export class Motions {
  readonly #gateway: Gateway;
  readonly #closed: AbortSignal;
  /** This program has requested motion or the lease, and has not released it since. */
  #mayDrive = false;
  /** By `now`: until then a move of this program may be under way, which needs heartbeats. */
  #movesUntilS = -Infinity;
  #beating: Promise<unknown> = Promise.resolve();

  /** `closed`: no heartbeat leaves any more. */
  constructor(gateway: Gateway, closed: AbortSignal) {
    this.#gateway = gateway;
    this.#closed = closed;
  }

  /** May take `moreS` longer than other requests, beside the board's identification. */
  async begin<P extends Path, V extends Verb<P>>(
    verb: V,
    path: P,
    given: Given<P, V>,
    { moreS = 0, untilS, signal }: Patience & { readonly moreS?: number },
  ): Promise<Answer<P, V>> {
    this.#mayDrive = true;
    const options = { isKeyed: true, moreS: IDENTIFIED_S + moreS, untilS, signal };
    return this.#gateway.call(verb, path, given, options).catch(async (error: unknown) => {
      const isLate = error instanceof UnreachableError && now() >= untilS;
      // It may have begun, or the program ends while it begins.
      if (isLate || !(error instanceof GatewayError)) await this.release();
      throw isLate ? new TimedOutError(LATE_WORDS) : error;
    });
  }

  /** A move has begun that is over in so many seconds. */
  begun(overInS: number): void {
    this.#movesUntilS = Math.max(this.#movesUntilS, now() + overInS + LATE_S);
  }

  /** Every slot of the board. The gateway recognises no repeat of it, so it has no key. */
  async erase(take: boolean): Promise<void> {
    this.#mayDrive = true;
    await this.#gateway.call(
      'post',
      '/api/erase',
      { body: { take } },
      { moreS: IDENTIFIED_S + SETTLED_S + ERASE_S },
    );
  }

  lease(action: LeaseWish['action']): Promise<LeaseState> {
    this.#mayDrive ||= action === 'request' || action === 'take';
    return this.#gateway.call('post', '/api/lease', { body: { action } }, { isSafe: true });
  }

  async release(): Promise<void> {
    if (!this.#mayDrive) return;
    await this.lease('release').catch((error: unknown) => {
      // A caller who may not drive has nothing in motion: the gateway has seen to that.
      if (!isOf(error, 'forbidden', 'notPaired')) throw error;
    });
    this.#mayDrive = false;
    this.#movesUntilS = -Infinity;
  }

  /** When the last heartbeat has left. */
  async ended(): Promise<void> {
    await this.#beating;
  }

  moved(overInS: number, patience: Patience): Promise<void> {
    const overS = now() + overInS + LATE_S;
    return this.#waited(patience, async () => {
      for (let leftS = overS - now(); leftS > 0; leftS = overS - now()) {
        await rest(Math.min(leftS, BEAT_S), patience);
        await this.#look(patience);
        await this.#heartbeat();
      }
    });
  }

  ran(slot: number, patience: Patience): Promise<void> {
    return this.#waited(patience, async () => {
      const isLimited = patience.untilS < Infinity;
      let untilS = isLimited ? patience.untilS : now() + UNKNOWN_END_S;
      let [beatenS, isComputed] = [now(), isLimited];
      for (let { running } = await this.#look(patience); running; { running } = await this.#look(patience)) {
        if (running.slot !== slot)
          throw new GatewayError('cancelled', `Another group runs now: slot ${running.slot}.`);
        if (!isComputed && running.endsInMs !== null)
          [untilS, isComputed] = [now() + running.endsInMs / 1000 + AFTER_END_S, true];
        if (now() > untilS)
          throw new TimedOutError(`The end of slot ${slot} was not reported in time, so it was stopped.`);
        beatenS = await this.#beatAfter(beatenS);
        await rest(LOOK_S, patience);
      }
    });
  }

  played(id: string, patience: Patience): Promise<void> {
    return this.#waited(patience, async () => {
      for (let beatenS = now(); ; beatenS = await this.#beatAfter(beatenS)) {
        const { play } = await this.#look(patience);
        if (play?.id !== id) throw new GatewayError('cancelled', 'Another group is played now.');
        if (play.status === 'ended') throw endedWith(play);
        if (play.status === 'done') return;
        await rest(LOOK_S, patience);
      }
    });
  }

  /** For what moves, runs or is played and is not waited for: heartbeats until it has ended. */
  beat(): void {
    const beats = async (): Promise<void> => {
      while (await this.#mayMove()) {
        if (!(await this.#heartbeat())) return;
        await pause(BEAT_S * 1000, this.#closed);
      }
    };
    // A failure is the next request's to say; the gateway stops the motion meanwhile.
    this.#beating = Promise.all([this.#beating, beats().catch(() => undefined)]);
  }

  async #mayMove(): Promise<boolean> {
    const { play, running, latch } = await this.#gateway.call('get', '/api/status', {}, { isSafe: true });
    return play?.status === 'playing' || running !== null || (now() < this.#movesUntilS && !latch);
  }

  /**
   * Whatever ends the waiting early ends the motion. A gateway that is not there any more ends it by itself, because no heartbeat
   * follows.
   */
  async #waited({ untilS }: Patience, work: () => Promise<void>): Promise<void> {
    try {
      await work();
    } catch (error) {
      const isLate = error instanceof UnreachableError && now() >= untilS;
      const isGone = error instanceof UnreachableError && !isLate;
      if (!isGone && !isOf(error, 'latched', 'notDriving')) await this.release();
      throw isLate ? new TimedOutError(LATE_WORDS) : error;
    }
  }

  async #beatAfter(beatenS: number): Promise<number> {
    if (now() - beatenS < BEAT_S) return beatenS;
    await this.#heartbeat();
    return now();
  }

  async #heartbeat(): Promise<boolean> {
    const { driver, drives } = await this.lease('heartbeat');
    if (driver !== null && !drives)
      throw new GatewayError('notDriving', `${driver} drives now, and motion was stopped first.`);
    return drives;
  }

  /** Rejects where the motion of this program has ended with a stop. */
  async #look({ untilS, signal }: Patience): Promise<Status> {
    const status = await this.#gateway.call('get', '/api/status', {}, { isSafe: true, untilS, signal });
    if (status.latch) throw new GatewayError('latched', 'Stopped: motion is refused until a person resumes.');
    return status;
  }
}

const LATE_WORDS = 'It did not end in time, so it was stopped.';

/** So many seconds. Throws a TimedOutError where the patience ends before. */
export async function rest(
  forS: number,
  { untilS, signal }: Patience,
  lateWords = LATE_WORDS,
): Promise<void> {
  await pause(Math.max(0, Math.min(forS, untilS - now())) * 1000, signal);
  if (now() >= untilS) throw new TimedOutError(lateWords);
}

const isOf = (error: unknown, ...codes: readonly string[]): boolean =>
  error instanceof GatewayError && codes.includes(error.code);

export const endedWith = ({ code, detail }: { code: string | null; detail: string | null }): GatewayError =>
  new GatewayError(code ?? 'cancelled', detail ?? '');
