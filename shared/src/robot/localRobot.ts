// A robot on a byte channel of this computer: what should happen, in what order, and what came back. Puts together the link, the
// queue, the replies and a driver for the board that is there. Knows no cable by name and no user interface.

import type { Clock } from '../clock.ts';
import { UNKNOWN_BOARD, type Family } from '../codec/families.ts';
import { commandIn, stopsIn } from '../codec/parse.ts';
import type { Report } from '../codec/reports.ts';
import type { ByteChannel } from './byteChannel.ts';
import { createChannelLink, createReceiver } from './channelLink.ts';
import type { SlotMemory } from './download.ts';
import { createDriver, type Driver } from './driver.ts';
import { createReplies } from './replies.ts';
import { createHalt, STOP_PACKET, createResync, createStopAgain } from './halt.ts';
import { createIdentification, QUESTIONS } from './identification.ts';
import type { LineState } from './link.ts';
import { LinkError } from './linkError.ts';
import { createQueue } from './queue.ts';
import type { Robot } from './robot.ts';
import { encodeOrRefuse } from './rules.ts';
import type { LinkState, SessionState } from './state.ts';
import { createSessionStore, noteReport, NOTHING_READ } from './store.ts';
import { LONGEST_MOVE_MS, OVERSLEPT_MS } from './timings.ts';

export interface LocalRobotOptions {
  readonly channel: ByteChannel;
  readonly clock: Clock;
  /** The assumed family of the board, by a person or from memory. Without it the board is identified, and waits for `choose`. */
  readonly family?: Family | undefined;
  /** Check `family` by harmless questions before anything moves, at each opening. Otherwise its word is enough. */
  readonly identifies?: boolean | undefined;
  /** Nothing can have moved it before: it begins with its link. */
  readonly isNew?: boolean | undefined;
  /** Whether a page is visible: then an idle board is checked from time to time. Absent: never. */
  readonly isWatched?: (() => boolean) | undefined;
  /** Without it broken slots are forgotten with the robot. */
  readonly slotMemory?: SlotMemory | undefined;
  readonly withheld?: SessionState['withheld'] | undefined;
}

export function createLocalRobot(options: LocalRobotOptions): Robot {
  const { channel, slotMemory, family = UNKNOWN_BOARD } = options;
  const { identifies = false, isWatched = () => false, withheld = [] } = options;
  const clock = createWakefulClock(options.clock, overslept);
  const store = createSessionStore({ family, canShare: false, withheld });
  const replies = createReplies(clock);
  /** The link was opened and not only mended. */
  let isOpened = false;
  let openedMs = 0;
  let alarmMv: number | null = null;
  /** The stops that follow the first answer behind an opening; null before that answer. */
  let atAnswer: Promise<void> | null = null;
  let endDoubt = (): void => undefined;

  const link = createChannelLink({
    channel,
    clock,
    received: (bytes, whole = false) => receiver.push(bytes, whole),
    unread: (bytes) => heardNoise('garbage', bytes),
    changed: lineChanged,
    claimed: () => halt.halt(),
  });

  const queue = createQueue({
    clock,
    serviceGapMs: UNKNOWN_BOARD.serviceGapMs,
    send: link.send,
    takeMove: () => driver.moves.take(),
    leaving: note,
    sent: take,
    moveFailed,
  });

  let driver: Driver = driverFor(family);
  const halt = createHalt({
    ...{ clock, store, queue, dropAll: (error) => driver.drop(error) },
    plan(holdsToFollow) {
      const leaving = queue.unfinished();
      return driver.core.estimate.haltPlan(leaving && commandIn(leaving), holdsToFollow);
    },
    hold: (isAgain) => (isAgain ? driver.core.estimate.holdAgain() : driver.core.estimate.hold()),
    unheldSince: (pressedMs, holdsToFollow) => driver.core.estimate.unheldSince(pressedMs, holdsToFollow),
    servosPerMove: () => driver.core.servosPerMove,
    encoded: (hold) => encodeOrRefuse(hold, driver.core.family),
    leftOverBytes: () => (channel.inReports === true ? 0 : store.state.family.leftOverBytes),
    confirmation,
  });
  const stopAgain = createStopAgain(
    clock,
    () => driver.core.estimate.deafUntilMs(),
    () => {
      if (driver.core.estimate.moving()) halt.again();
    },
  );
  const resync = createResync(queue, () => driver.core.estimate.filled());
  const identification = createIdentification({
    ...{ clock, store, queue, replies, family, identifies, isWatched },
    isMoving: () => driver.core.estimate.moving(),
    readBattery: () => driver.readBattery(),
    answered: () => atAnswer ?? Promise.resolve(),
    drive,
    entered,
  });
  const receiver = createReceiver({
    clock,
    family: identification.familyOnLine,
    report: heard,
    noise: heardNoise,
  });

  function driverFor(next: Family): Driver {
    return createDriver(next, {
      clock,
      store,
      queue,
      endMotion: () => halt.endMotion(),
      insistOnEnd: (isWanted) => halt.insistOnEnd(isWanted),
      replies,
      slotMemory,
      longestPacket: channel.longestPacket,
      alarmMv: () => alarmMv,
    });
  }

  function moveFailed(error: LinkError): void {
    driver.player.moveFailed();
    store.emit('problem', error);
  }

  /** The board is taken for something else: whatever was believed of it was about another one. */
  function drive(next: Family): void {
    if (next === driver.core.family) return;
    driver.drop(new LinkError('cancelled', 'the board is taken for another one now'));
    driver = driverFor(next);
    store.update({
      ...{ family: next, brokenSlots: [], storedSlots: [], lastDownload: null },
      ...NOTHING_READ,
      battery: { kind: 'unread' },
    });
  }

  /** What waited to leave does not any more; a group that the board plays continues, and so does a download. */
  function overslept(): void {
    const error = new LinkError('overslept', 'this computer or page slept');
    if (driver.dropMoves()) store.emit('problem', error);
    if (store.state.activity.kind !== 'downloading') queue.purge(error);
  }

  /** Into the log when it begins to leave, so that its answer comes after it. */
  function note(bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'out', bytes, command: commandIn(bytes) });
  }

  /** Into the estimate when it has left: not before can the board act on it. */
  function take(packet: Uint8Array): void {
    const command = commandIn(packet);
    if (command === null) return;
    for (let count = Math.max(1, stopsIn(packet)); count > 0; count -= 1) driver.applied(command);
    if (command.kind === 'stop') stopAgain.stopped();
  }

  /** While the board is identified, questions of that kind are out already; one that is busy would keep it from the stops (S9). */
  function confirmation() {
    const { link: line, family: present } = store.state;
    const isAskable = line.status === 'ready' || line.status === 'stale';
    const isBusy = driver.core.estimate.deafUntilMs() > clock.now();
    if (present.stopConfirmedBy === null || !isAskable || isBusy) return null;
    const { command, answer } = QUESTIONS[present.stopConfirmedBy];
    return { question: encodeOrRefuse(command, present), answer };
  }

  function heard(report: Report, bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, report });
    queue.answered(bytes[3] ?? 0);
    const isAnswer = replies.deliver(report);
    if (isAnswer && store.state.link.status === 'identifying')
      atAnswer ??= halt.stopAtAnswer().catch(() => undefined);
    const mightSwallow = driver.core.estimate.maySwallow();
    driver.groups.heard(report);
    noteReport(store, report, clock.now());
    if (report.kind === 'runStopped') halt.confirmed();
    halt.heard(report.kind);
    stopAgain.heard();
    const hearsAgain = mightSwallow && !driver.core.estimate.maySwallow();
    if (hearsAgain || report.kind === 'runAccepted' || report.kind === 'runStarted') halt.again();
    identification.heard(report, bytes);
  }

  function heardNoise(noise: 'garbage' | 'truncated', bytes: Uint8Array): void {
    store.emit('traffic', { atMs: clock.now(), direction: 'in', bytes, noise });
    identification.heardNoise(bytes);
  }

  function lineChanged(line: LineState): void {
    if (line.status !== 'open') {
      identification.ended();
      entered(line);
      return;
    }
    isOpened = !line.isReturn;
    const isUntouched = isOpened && options.isNew === true;
    if (!isUntouched) queue.returned();
    resync.send();
    atAnswer = isUntouched ? Promise.resolve() : null;
    doubt(identifies && !isUntouched);
    identification.begin(isUntouched ? null : stopAtOpening(line.isReturn));
  }

  async function stopAtOpening(isReturn: boolean): Promise<void> {
    await halt.opened(isReturn);
    openedMs = clock.now();
  }

  /** Whether what others began may go on. A board that is taken at its family's word is one that this program began itself. */
  function doubt(mayBeRunning: boolean): void {
    endDoubt();
    endDoubt = () => undefined;
    if (store.state.mayBeRunning !== mayBeRunning) store.update({ mayBeRunning });
  }

  /** One that answers nothing has finished its longest frame by then. */
  function judgeDoubt(): void {
    if (store.state.identity.evidence.some(({ kind }) => kind === 'answered')) doubt(false);
    else endDoubt = clock.after(LONGEST_MOVE_MS, () => doubt(false));
  }

  function entered(next: LinkState): void {
    const previous = store.state.link.status;
    if (next.status === 'ready' && next.status !== previous) becomesReady();
    store.update({ link: next });
    if (next.status === previous) return;
    if (previous === 'stale' && link.isOpen) halt.stopAfterReturn();
    if (previous === 'ready') unlinked(next);
  }

  /** Listeners find what is known of its slots and servos. */
  function becomesReady(): void {
    driver.groups.linked();
    if (store.state.mayBeRunning) judgeDoubt();
    if (isOpened && options.isNew !== true) driver.core.estimate.opened(openedMs);
    isOpened = false;
  }

  /** The board may have moved, restarted or been changed for another before it is ready again. */
  function unlinked(next: LinkState): void {
    const packet = queue.unfinished();
    stopAgain.void();
    if (!link.isOpen) doubt(false);
    if (!link.isOpen) receiver.reset();
    driver.core.estimate.forget(packet && commandIn(packet));
    if (packet !== null && !link.isOpen) {
      resync.cut(packet, driver.core.family.resyncFiller);
      driver.core.estimate.cut();
    }
    // Nothing ends it at the return.
    if (next.status === 'closed') driver.core.estimate.groupEnded();
    driver.groups.unlinked();
    store.update(NOTHING_READ);
    if (next.status === 'lost' || next.status === 'stale') halt.latchedByLoss();
    else driver.drop(new LinkError('closed', 'the link was closed'));
  }

  const mayMove = (): boolean => store.state.activity.kind === 'running' || driver.core.estimate.moving();

  return {
    get state() {
      return store.state;
    },
    subscribe: store.subscribe,
    open: link.open,
    async close() {
      // A line that is lost meanwhile takes no more stops.
      if (link.isOpen && mayMove()) await halt.endBeforeClosing().catch(() => undefined);
      await link.close();
      store.update({ latch: null });
    },
    retryNow: link.retryNow,
    takeOver: link.takeOver,
    leave: () => link.leave(STOP_PACKET),
    setAutoReconnect: link.setAutoReconnect,
    identify: () => settled(identification.again),
    choose: (chosen) => settled(() => identification.choose(chosen)),
    // No other client can drive, and the limits are the page's own.
    lease: () => undefined,
    letRun: () => undefined,
    calibrate: () => undefined,
    limitsChanged: () => driver.core.estimate.dropParts(),
    move: (targets, durationMs) => driver.moves.put(targets, durationMs),
    run: (slot, times, how) => driver.groups.run(slot, times, how?.anyway),
    stopGroup: () => driver.groups.stop(),
    halt: halt.halt,
    resume: halt.resume,
    erase: () => driver.groups.erase(),
    readBattery: () => driver.readBattery(),
    refuseRunsBelow: (next) => (alarmMv = next),
    sendRaw: (packet) => driver.sendRaw(packet),
    readPositions: (servos) => driver.readings.readPositions(servos),
    readVersion: () => driver.readings.readVersion(),
    readOffsets: () => driver.readings.readOffsets(),
    setSpeed: (slot, percent) => driver.groups.setSpeed(slot, percent),
    release: (servos) => driver.release(servos),
    download: (groups) => driver.groups.store(groups),
    cancelDownload: () => settled(() => driver.groups.cancel()),
    play: (frames, how = {}) => driver.player.play(frames, how),
    stopPlaying: () => driver.player.stop(),
    motions: () => driver.core.estimate.motions(),
    isMoving: () => driver.core.estimate.moving(),
  };
}

/** What is done at once, as a promise: with what it throws. */
const settled = (work: () => void): Promise<void> =>
  new Promise((resolve) => {
    work();
    resolve();
  });

/**
 * Notices when a timer fires far too late: the computer slept, or the browser froze the page. What was to happen before must not happen
 * now (safety.md section 5, I3). `overslept` is called before a late timer's own work, which it may still cancel.
 */
function createWakefulClock(clock: Clock, overslept: () => void): Clock {
  return {
    now: () => clock.now(),
    after(delayMs, run) {
      const dueMs = clock.now() + delayMs;
      let isCancelled = false;
      const cancelTimer = clock.after(delayMs, () => {
        if (clock.now() - dueMs > OVERSLEPT_MS) overslept();
        if (!isCancelled) run();
      });
      return () => {
        isCancelled = true;
        cancelTimer();
      };
    },
  };
}
