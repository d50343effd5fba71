// Which board is at the other end, through a link's whole life: asked at each opening, weighed against what it is taken for,
// confirmed by a person, watched while idle. Decides when a link is ready; the questions are identify.ts, their meaning is
// identity.ts.

import type { Clock } from '../clock.ts';
import { family as familyOf, UNKNOWN_BOARD, type Family, type Question } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';
import { createExchange, isNoAnswer } from './exchange.ts';
import { createHeartbeat } from './heartbeat.ts';
import { isEcho, QUESTIONS, identify } from './identify.ts';
import { fitOf, identityFrom, NOTHING_HEARD, type SharedBoard } from './identity.ts';
import type { Lanes } from './queue.ts';
import { LinkError, type LinkErrorCode } from './linkError.ts';
import type { Replies } from './replies.ts';
import type { LinkState } from './state.ts';
import type { SessionStore } from './store.ts';
import { IDENTIFY_TIMEOUT_MS } from './timings.ts';
import type { Transport } from './transport.ts';

export interface IdentificationOptions {
  readonly clock: Clock;
  readonly store: SessionStore;
  readonly lanes: Lanes;
  readonly replies: Replies;
  readonly transport: Transport;
  /** What the board is taken for until somebody says otherwise. */
  readonly family: Family;
  readonly identifies: boolean;
  isWatched(): boolean;
  /** Shows its answer, and shares it with whoever asks at the same time. */
  readBattery(): Promise<number>;
  /** Something moves: no time for questions. */
  isMoving(): boolean;
  /** From now on the session speaks to such a board. */
  drive(family: Family): void;
  entered(state: LinkState): void;
}

export interface Identification {
  /** The line is open. */
  begin(): void;
  /** The line is down. */
  ended(): void;
  /** A shared link asks the board itself: its word counts. */
  told(board: SharedBoard): void;
  again(): Promise<void>;
  choose(family: Family): Promise<void>;
  /** What a report is read as at this moment. */
  heardAs(): Family;
  heard(report: Report, bytes: Uint8Array): void;
  heardNoise(bytes: Uint8Array): void;
}

export function createIdentification(options: IdentificationOptions): Identification {
  const { clock, store, lanes, replies, transport, identifies, drive, entered } = options;
  const exchange = createExchange(UNKNOWN_BOARD, clock, lanes, replies);
  let claim = options.family;
  let lineIsOpen = false;
  let shared: SharedBoard | null = null;
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
    else if (claim === UNKNOWN_BOARD) refuse('boardUnknown', 'nobody has said which board this is');
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

  function follow({ board, status, error, identity }: SharedBoard): void {
    drive(board === 'unknown' ? UNKNOWN_BOARD : familyOf(board));
    store.update({ identity });
    if (status === 'refused') entered({ status, error });
    else entered(status === 'stale' ? { status, sinceMs: clock.now() } : { status });
  }

  function hears(bytes: Uint8Array): void {
    if (isEcho(bytes)) echoes += 1;
  }

  return {
    begin() {
      lineIsOpen = true;
      store.update({ identity: NOTHING_HEARD });
      if (shared !== null) follow(shared);
      else if (identifies) begunCheck();
      else accept(false);
    },
    ended() {
      lineIsOpen = false;
      shared = null;
      round += 1;
      heartbeat.stop();
    },
    told(board) {
      shared = board;
      if (lineIsOpen) follow(board);
    },
    async again() {
      if (!lineIsOpen) throw new LinkError('closed', 'the link is not open');
      if (store.state.activity.kind !== 'idle' || options.isMoving())
        throw new LinkError('busy', 'the robot is moving: wait or stop it first');
      if (transport.setBoard !== undefined) return transport.setBoard('unknown');
      begunCheck();
    },
    async choose(family) {
      if (transport.setBoard !== undefined) return transport.setBoard(family.id);
      claim = family;
      if (!lineIsOpen || status() === 'identifying') return;
      // What a board that is silent answered once says nothing of what is there now.
      if (status() === 'stale') begunCheck();
      else judge();
    },
    heardAs: () => (status() === 'identifying' ? UNKNOWN_BOARD : store.state.family),
    heard(report, bytes) {
      hears(bytes);
      heartbeat.heard();
      if (status() !== 'stale' || shared !== null || report.kind === 'unknown') return;
      if (identifies) begunCheck();
      else accept(false);
    },
    heardNoise(bytes) {
      hears(bytes);
      noiseBytes += bytes.length;
    },
  };
}
