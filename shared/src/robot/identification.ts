// Which board is at the other end, through a link's whole life: asked at each opening, weighed against what it is taken for,
// confirmed by a person, watched while idle. Decides when a link is ready; the questions are identify.ts, their meaning is
// identity.ts.

import type { Clock } from '../clock.ts';
import { UNKNOWN_BOARD, type Family, type Question } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';
import { createExchange, isNoAnswer, type Replies } from './replies.ts';
import { isEcho, QUESTIONS, identify } from './identify.ts';
import { fitOf, identityFrom, NOTHING_HEARD } from './identity.ts';
import { LinkError, type LinkErrorCode } from './linkError.ts';
import type { Queue } from './queue.ts';
import { requireIdle } from './rules.ts';
import type { LinkState } from './state.ts';
import type { SessionStore } from './store.ts';
import { IDENTIFY_TIMEOUT_MS, HEARTBEAT_MISSES, HEARTBEAT_MS, STALE_HEARTBEAT_MS } from './timings.ts';

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
  /** From now on such a board is spoken to. */
  drive(family: Family): void;
  entered(state: LinkState): void;
}

interface Identification {
  /** The line is open. */
  begin(): void;
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

  async function check(): Promise<void> {
    const mine = (round += 1);
    heartbeat.stop();
    entered({ status: 'identifying' });
    const evidence = await identify({ clock, exchange, noiseBytes: () => noiseBytes, echoes: () => echoes });
    if (mine !== round) return;
    store.update({ identity: identityFrom(evidence) });
    judge();
  }

  function begunCheck(): void {
    check().catch((error: unknown) => {
      // Where the line went while questions were out, its state says so already.
      if (lineIsOpen && status() === 'identifying')
        refuse(error instanceof LinkError ? error.code : 'internal', String(error));
    });
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
    begin() {
      lineIsOpen = true;
      store.update({ identity: NOTHING_HEARD });
      if (identifies) begunCheck();
      else accept(false);
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
      claim = family;
      if (!lineIsOpen || status() === 'identifying') return;
      // What a board that is silent answered once says nothing of what is there now.
      if (status() === 'stale') begunCheck();
      else judge();
    },
    familyOnLine: () => (status() === 'identifying' ? UNKNOWN_BOARD : store.state.family),
    heard(report, bytes) {
      hears(bytes);
      heartbeat.heard();
      if (status() !== 'stale' || report.kind === 'unknown') return;
      if (identifies) begunCheck();
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
  /** The question, or null while it may not be asked: no page is visible, something runs, no such board answers anything. */
  question(): Question | null;
  /** Sends it and waits; false when no answer came, null when that is uncertain. */
  ask(question: Question): Promise<boolean | null>;
  gone(): void;
}

interface Heartbeat {
  /** `isGone`: it has been silent already, so it is asked more often. */
  start(isGone: boolean): void;
  stop(): void;
  /** The board said something: no need to ask for a while. */
  heard(): void;
}

/** Asks an idle board whether it is still there, by the cheapest harmless question that such a board always answers. */
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
    const asked = question();
    const answered = asked && (await ask(asked));
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
