// Which board is at the other end, for the whole life of a link: queried at each opening, compared with the assumed one, confirmed by a
// person, observed while idle. Sends the queries and decides when a link is ready; the meaning of the answers is identity.ts.

import { type Clock, sleep } from '../clock.ts';
import { UNKNOWN_BOARD, type Family, type Question } from '../codec/families.ts';
import type { Report, ReportKind } from '../codec/reports.ts';
import { createExchange, isNoAnswer, type Replies, type Exchange } from './replies.ts';
import { fitOf, identityFrom, NOTHING_HEARD, type Evidence } from './identity.ts';
import { LinkError, type LinkErrorCode } from './linkError.ts';
import type { Queue } from './queue.ts';
import { requireIdle } from './rules.ts';
import type { LinkState } from './state.ts';
import type { SessionStore } from './store.ts';
import {
  IDENTIFY_TIMEOUT_MS,
  HEARTBEAT_MISSES,
  HEARTBEAT_MS,
  STALE_HEARTBEAT_MS,
  BOOT_MS,
  IDENTIFY_ATTEMPTS,
  IDENTIFY_LISTEN_MS,
} from './timings.ts';
import type { Command } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { toHex } from '../codec/packet.ts';

interface IdentificationOptions {
  readonly clock: Clock;
  readonly store: SessionStore;
  readonly queue: Queue;
  readonly replies: Replies;
  /** The family of the board until a person chooses another. */
  readonly family: Family;
  readonly identifies: boolean;
  isWatched(): boolean;
  /** Shows its answer, and shares it with others who ask at the same time. */
  readBattery(): Promise<number>;
  /** Something moves: no time for questions. */
  isMoving(): boolean;
  /** Resolves when the stops have left that follow its first answer. */
  answered(): Promise<void>;
  /** From now on such a board is spoken to. */
  drive(family: Family): void;
  entered(state: LinkState): void;
}

interface Identification {
  /** The line is open, and nothing is asked before these stops have left; null: there are none. */
  begin(stops: Promise<void> | null): void;
  /** The line is down. */
  ended(): void;
  /** Throws where the link is not open or something moves. */
  again(): void;
  choose(family: Family): void;
  /** What a report is read as at this moment. */
  familyOnLine(): Family;
  heard(report: Report, bytes: Uint8Array): void;
  heardNoise(bytes: Uint8Array): void;
}

export function createIdentification(options: IdentificationOptions): Identification {
  const { clock, store, queue, replies, identifies, drive, entered } = options;
  const exchange = createExchange(UNKNOWN_BOARD, clock, queue, replies);
  let claim = options.family;
  /** Until another family is chosen, the word of the starter may be enough. */
  let isDoubted = identifies;
  let lineIsOpen = false;
  /** Counts what makes a round of questions pointless: the line went, or another round began. */
  let round = 0;
  let noiseBytes = 0;
  let echoes = 0;

  const heartbeat = createHeartbeat({ clock, question: heartbeatQuestion, ask: isAnswered, gone });
  const status = (): LinkState['status'] => store.state.link.status;

  function heartbeatQuestion(): Question | null {
    const [question = null] = claim.certainAnswers;
    const isIdle = store.state.activity.kind === 'idle' && !options.isMoving();
    return isIdle && options.isWatched() ? question : null;
  }

  async function isAnswered(question: Question): Promise<boolean | null> {
    const { command, answer } = QUESTIONS[question];
    try {
      if (question === 'readBattery') await options.readBattery();
      else await exchange.ask(command, answer, IDENTIFY_TIMEOUT_MS);
      return true;
    } catch (error) {
      return isNoAnswer(error) ? false : null;
    }
  }

  function gone(): void {
    if (status() === 'ready') entered({ status: 'stale', sinceMs: clock.now() });
  }

  async function check(stops: Promise<void> | null): Promise<void> {
    const mine = (round += 1);
    heartbeat.stop();
    entered({ status: 'identifying' });
    const heard = { noiseBytes: () => noiseBytes, echoes: () => echoes };
    const evidence = await identify({ clock, exchange, stops, ...heard });
    await options.answered();
    if (mine !== round) return;
    store.update({ identity: identityFrom(evidence) });
    judge();
  }

  function begunCheck(stops: Promise<void> | null = null): void {
    check(stops).catch(failed);
  }

  /** Where the line went while questions were out, its state says so already. */
  function failed(error: unknown): void {
    if (lineIsOpen && status() === 'identifying')
      refuse(error instanceof LinkError ? error.code : 'internal', String(error));
  }

  /** The family's word is enough. */
  async function acceptBehind(stops: Promise<void>): Promise<void> {
    const mine = (round += 1);
    entered({ status: 'identifying' });
    await stops;
    if (mine === round) accept(false);
  }

  function judge(): void {
    const { evidence } = store.state.identity;
    const fit = fitOf(claim, evidence);
    if (evidence.some(({ kind }) => kind === 'echoed'))
      refuse('echo', 'the line sends back what it is given');
    else if (claim === UNKNOWN_BOARD) refuse('boardUnknown', 'it is not known which board this is');
    else if (fit === 'contradicts') refuse('wrongBoard', `this does not answer like a ${claim.name}`);
    else accept(fit === 'silent');
  }

  function refuse(code: LinkErrorCode, message: string): void {
    heartbeat.stop();
    drive(UNKNOWN_BOARD);
    entered({ status: 'refused', error: new LinkError(code, message) });
  }

  function accept(isSilent: boolean): void {
    drive(claim);
    entered(isSilent ? { status: 'stale', sinceMs: clock.now() } : { status: 'ready' });
    heartbeat.start(isSilent);
  }

  function hears(bytes: Uint8Array): void {
    if (isEcho(bytes)) echoes += 1;
  }

  return {
    begin(stops) {
      lineIsOpen = true;
      store.update({ identity: NOTHING_HEARD });
      if (isDoubted) begunCheck(stops);
      else if (stops === null) accept(false);
      else acceptBehind(stops).catch(failed);
    },
    ended() {
      lineIsOpen = false;
      round += 1;
      heartbeat.stop();
    },
    again() {
      if (!lineIsOpen) throw new LinkError('closed', 'the link is not open');
      requireIdle(store.state, options);
      begunCheck();
    },
    choose(family) {
      const isOpen = lineIsOpen && status() !== 'identifying';
      // A board that was not asked was taken at the word of its starter, which was another one.
      const mustAsk = isOpen && family !== claim && store.state.identity.evidence.length === 0;
      // What moves would be forgotten, and nothing would end it. Behind a STOP stops go on to any board.
      if (isOpen && family !== claim && (mustAsk || store.state.latch === null))
        requireIdle(store.state, options);
      if (family !== claim) isDoubted = true;
      claim = family;
      if (!isOpen) return;
      // What a board that is silent answered once says nothing of what is there now.
      if (mustAsk || status() === 'stale') begunCheck();
      else judge();
    },
    familyOnLine: () => (identifies && status() === 'identifying' ? UNKNOWN_BOARD : store.state.family),
    heard(report, bytes) {
      hears(bytes);
      heartbeat.heard();
      if (status() !== 'stale' || report.kind === 'unknown') return;
      if (isDoubted) begunCheck();
      else accept(false);
    },
    heardNoise(bytes) {
      hears(bytes);
      noiseBytes += bytes.length;
    },
  };
}

interface HeartbeatOptions {
  readonly clock: Clock;
  /** The query, or null while it may not be sent: no page is visible, something runs, no such board answers anything. */
  question(): Question | null;
  /** Sends it and waits; false when no answer came, null when that is uncertain. */
  ask(question: Question): Promise<boolean | null>;
  gone(): void;
}

interface Heartbeat {
  /** `isGone`: it has been silent already, so it is queried more often. */
  start(isGone: boolean): void;
  stop(): void;
  /** The board said something: no need to ask for a while. */
  heard(): void;
}

/** Checks whether an idle board is still there, by the cheapest harmless query that such a board always answers. */
function createHeartbeat({ clock, question, ask, gone }: HeartbeatOptions): Heartbeat {
  let runs = false;
  let misses = 0;
  let cancelTimer = (): void => undefined;
  /** Counts lives, so that an answer to an old one's question is no answer now. */
  let life = 0;

  function wait(): void {
    cancelTimer();
    cancelTimer = clock.after(misses === 0 ? HEARTBEAT_MS : STALE_HEARTBEAT_MS, () => void beat(life));
  }

  async function beat(mine: number): Promise<void> {
    const requested = question();
    const answered = requested && (await ask(requested));
    if (mine !== life) return;
    if (answered === false) misses += 1;
    if (answered === false && misses === HEARTBEAT_MISSES) gone();
    wait();
  }

  return {
    start(isGone) {
      life += 1;
      runs = true;
      misses = isGone ? HEARTBEAT_MISSES : 0;
      wait();
    },
    stop() {
      life += 1;
      runs = false;
      cancelTimer();
    },
    heard() {
      misses = 0;
      if (runs) wait();
    },
  };
}

export interface IdentifyOptions {
  readonly clock: Clock;
  readonly exchange: Exchange;
  /** What has to leave before the first question. */
  readonly stops: Promise<void> | null;
  /** Bytes heard so far that were no packets. */
  noiseBytes(): number;
  /** Packets heard so far that were our own question. */
  echoes(): number;
}

export const QUESTIONS: Readonly<
  Record<Question, { readonly command: Command; readonly answer: ReportKind }>
> = {
  readBattery: { command: { kind: 'readBattery' }, answer: 'battery' },
  readVersion: { command: { kind: 'readVersion' }, answer: 'version' },
  // One servo's is enough: bus boards answer, the others do not know the question.
  readPositions: { command: { kind: 'readPositions', servos: [1] }, answer: 'positions' },
};

/** Rejects when the link goes meanwhile. */
export async function identify({
  clock,
  exchange,
  stops,
  noiseBytes,
  echoes,
}: IdentifyOptions): Promise<readonly Evidence[]> {
  const noiseBefore = noiseBytes();
  const echoesBefore = echoes();

  async function attempt({ command, answer }: (typeof QUESTIONS)[Question], question: Question) {
    try {
      const report = await exchange.ask(command, answer, IDENTIFY_TIMEOUT_MS);
      return { kind: 'answered', question, report } as const;
    } catch (error) {
      // A stop empties the queue; it does not answer the question.
      if (isNoAnswer(error) || isLatched(error)) return null;
      throw error;
    }
  }

  async function ask(question: Question): Promise<Evidence> {
    for (let left = IDENTIFY_ATTEMPTS; left > 0; left -= 1) {
      const answered = await attempt(QUESTIONS[question], question);
      if (answered !== null) return answered;
    }
    return { kind: 'silent', question };
  }

  async function askAll(): Promise<readonly Evidence[]> {
    const battery = await ask('readBattery');
    return [battery, await ask(battery.kind === 'answered' ? 'readPositions' : 'readVersion')];
  }

  await Promise.all([sleep(clock, IDENTIFY_LISTEN_MS), stops]);
  let answers = await askAll();
  // Text lines come from a LeArm that has just restarted and is deaf for a while (L1).
  const isStarting = noiseBytes() > noiseBefore && echoes() === echoesBefore;
  if (isStarting && answers.every(({ kind }) => kind === 'silent')) {
    await sleep(clock, BOOT_MS);
    answers = await askAll();
  }
  const byteCount = noiseBytes() - noiseBefore;
  return [
    ...answers,
    ...(echoes() > echoesBefore ? [{ kind: 'echoed' } as const] : []),
    ...(byteCount > 0 ? [{ kind: 'noise', byteCount } as const] : []),
  ];
}

const QUESTION_TEXTS = Object.values(QUESTIONS).map(({ command }) =>
  toHex(encodeCommand(command, UNKNOWN_BOARD)),
);

/** What came in holds one of our own questions. */
export function isEcho(bytes: Uint8Array): boolean {
  const text = toHex(bytes);
  return QUESTION_TEXTS.some((question) => text.includes(question));
}

function isLatched(error: unknown): boolean {
  return error instanceof LinkError && error.code === 'latched';
}
