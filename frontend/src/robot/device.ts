// The robot as the page sees it: wraps one robot at a time, keeps its latest snapshot, and turns intents of the panels into calls
// whose failures become notices. Live, never undoable; knows no link and no panel. What changes in each frame is read
// by calls and is not in the store, whose listeners would run each time.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { sameList } from '#shared/group/groupEdits.ts';
import { refusedBelowMv } from '#shared/profile/battery.ts';
import { fromBoard, onBoard, type Robot as RobotProfile } from '#shared/profile/robot.ts';
import type { Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Family, FamilyId } from '#shared/codec/families.ts';
import type { LeaseAction } from '#shared/robot/lease.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import type { Motions, ServoMotion, SessionState } from '#shared/robot/state.ts';
import { personName } from '../i18n/sentences.ts';
import { words } from '../i18n/words.ts';
import { createBoardVerbs, type BoardVerbs, createLateNotices } from './boardVerbs.ts';
import { createMovingWatch, createTargetBook, moveDurationMs, type Pace, createLimitGate } from './moves.ts';
import type { Notices } from '../state/notices.ts';
import {
  createTrafficLog,
  type TrafficLog,
  createUnsolicitedAnswers,
  type UnsolicitedAnswers,
} from './traffic.ts';

export type WayKind = 'webSerial' | 'webHid' | 'webBluetooth' | 'gateway' | 'simulated';

/** Which way leads to the robot, and the name of the port or machine for people. */
export interface Way {
  readonly kind: WayKind;
  readonly label: string;
  /** Nothing real moves, whichever way leads there. */
  readonly isSimulated: boolean;
}

/** Boards have no name of their own: the device they are on is all there is to know them by. */
export const nameOf = ({ kind, label }: Pick<Way, 'kind' | 'label'>): string => `${kind} ${label}`;

export interface DeviceState {
  readonly family: Family;
  readonly way: Way | null;
  readonly snapshot: SessionState;
  /** Servos that were commanded, or whose position the board has reported; the position of others is unknown. */
  readonly known: readonly number[];
  /** Those of them whose place is the board's own word. */
  readonly readServos: readonly number[];
  /** A servo is on its way, as far as can be known; looked at now and then, and true for a moment between two moves. */
  readonly isMoving: boolean;
}

export interface Device extends BoardVerbs {
  readonly store: StoreApi<DeviceState>;
  readonly traffic: TrafficLog;
  readonly clock: Clock;
  /** Takes the robot over and closes the one before it. */
  attach(robot: Robot, way: Way): void;
  /** What the robot's way leads to became known. */
  describe(robot: Robot, way: Way): void;
  detach(): Promise<void>;
  /** The last commanded position of each, from that moment on, and where it is by now: as of this moment. */
  motions(): Motions;
  motion(servo: number): ServoMotion;
  /** The last commanded pose, or at rest the pose that the board reported; without servos of unknown place. */
  pose(): readonly ServoTarget[];
  /** Nothing moves and nothing is under way, as far as can be known. */
  isAtRest(): boolean;
  /** Looks what became of the motion; to be called while the page is drawn, once a frame. */
  refresh(motion?: Motions): void;
  /** Servos whose newest target has not left yet. */
  waiting(): number;
  /** False where it was refused, with a notice. */
  move(targets: readonly ServoTarget[], pace: Pace): boolean;
  /** As `move`, between two frames: the store has what comes of it with the next one. */
  drag(targets: readonly ServoTarget[], pace: Pace): boolean;
  /** This servo's limits are looked for: `jog` moves it, also beyond the present ones. null: no longer. */
  calibrate(servo: number | null): void;
  /** Moves the servo that is calibrated, as far as its board can. */
  jog(position: number, durationMs: number): void;
  /** About who drives a robot that is shared. */
  lease(action: LeaseAction): void;
  /** The run under way may go on without this page, for so long at most; null: it may not. */
  keepRunning(forMs: number | null): void;
  retryNow(): void;
  /** Holds for later sessions too. */
  setAutoReconnect(enabled: boolean): void;
}

/** Failures after which the link is tried again and again. */
const TRIED_ON = ['lost', 'portMissing', 'portBusy'] as const;

const NOTHING = { way: null, snapshot: INITIAL_STATE, known: [], readServos: [], isMoving: false } as const;

const NO_MOTION: ServoMotion = { target: null, estimated: null };

/** The robot profile in use: its limits and trims hold for everything that moves. */
export interface RobotProfiles {
  readonly store: { subscribe(listener: () => void): () => void };
  current(): { readonly robot: RobotProfile };
  /** On a link of one's own the profile becomes one for the board that is connected. */
  takeUpFor(board: FamilyId): void;
}

export interface DeviceOptions {
  readonly family: Family;
  readonly clock: Clock;
  readonly notices: Notices;
  readonly robots: RobotProfiles;
}

/** Equal where two profiles let the same servos go equally far. */
const limitsOf = ({ servos }: RobotProfile): string =>
  servos.map(({ servo, min, max }) => `${servo}:${min}..${max}`).join();

export function createDevice({ family, clock, notices, robots }: DeviceOptions): Device {
  const store = createStore<DeviceState>(() => ({ family, ...NOTHING }));
  const traffic = createTrafficLog();
  const book = createTargetBook(clock);
  const watch = createMovingWatch(clock, isUnderWay, () => session?.isMoving() ?? false);
  const lateNotices = createLateNotices(clock, notices);
  let session: Robot | null = null;
  let unsubscribe = (): void => undefined;
  let autoReconnect = true;
  let saidOfResume = '';
  let calibrated: number | null = null;
  /** Names the board that was connected last. */
  let boardName = '';
  let unsolicited: UnsolicitedAnswers = () => undefined;

  const robot = (): RobotProfile => robots.current().robot;
  const inRobotUnits = (servo: number, onBoardAt: number): number => fromBoard(robot(), servo, onBoardAt);
  const gate = createLimitGate(robot, notices.refuse);

  /** On a link of one's own it is the last one described for such a board. */
  function takeUpRobot({ family: connected, robotOnBoard }: SessionState): void {
    if (robotOnBoard === null && connected.id !== 'unknown') robots.takeUpFor(connected.id);
  }

  let limits = limitsOf(robot());

  robots.store.subscribe(() => {
    takeUpRobot(store.getState().snapshot);
    const next = limitsOf(robot());
    if (next !== limits) session?.limitsChanged();
    limits = next;
    session?.refuseRunsBelow(refusedBelowMv(robot()));
  });

  function motions(): Motions {
    if (session === null) return () => NO_MOTION;
    const onBoardNow = session.motions();
    const { waitingToStart } = session.state;
    const targetOf = book.targets();
    return (servo) => {
      const { target, estimated, reported } = onBoardNow(servo);
      const sent = target === null ? null : Math.round(inRobotUnits(servo, target));
      const now = {
        target: targetOf(servo, sent, waitingToStart.includes(servo)),
        estimated: estimated === null ? null : inRobotUnits(servo, estimated),
      };
      // Once it is commanded, the board's report is its start.
      return reported === undefined || now.target !== sent ? now : { ...now, reported };
    };
  }

  function pose(): readonly ServoTarget[] {
    const motion = motions();
    const requested = robot().servos.flatMap(({ servo }) => {
      const { target } = motion(servo);
      return target === null ? [] : [{ servo, position: target }];
    });
    return requested.toSorted((one, other) => one.servo - other.servo);
  }

  function isAtRest(): boolean {
    return store.getState().snapshot.activity.kind === 'idle' && !isUnderWay();
  }

  function isUnderWay(): boolean {
    if (session === null) return false;
    if (session.isMoving()) return true;
    const motion = motions();
    // What was requested and has not left.
    return robot().servos.some(({ servo }) => {
      const { target, estimated } = motion(servo);
      // Without a target we moved it nowhere, even where the board said where it is.
      return target !== null && target !== estimated;
    });
  }

  function refresh(motion: Motions = motions()): void {
    const before = store.getState();
    const servos = robot().servos.map(({ servo }) => servo);
    const known = sameList(
      before.known,
      servos.filter((servo) => motion(servo).target !== null),
    );
    const readServos = sameList(
      before.readServos,
      servos.filter((servo) => motion(servo).reported !== undefined),
    );
    if (known !== before.known || readServos !== before.readServos) store.setState({ known, readServos });
    const isMoving = watch.isMoving();
    if (isMoving !== before.isMoving) store.setState({ isMoving });
  }

  /** What a latch or a failure swallowed will not come. */
  function forgetWishes(): void {
    book.clear();
    refresh();
  }

  function noteState(snapshot: SessionState): void {
    const wasReady = store.getState().snapshot.link.status === 'ready';
    takeUpRobot(snapshot);
    const becomesReady = !wasReady && snapshot.link.status === 'ready';
    if (becomesReady && calibrated !== null) session?.calibrate(calibrated);
    // First into the log: a listener of the state may send something at once.
    traffic.note(snapshot, clock.now(), snapshot.family.id);
    store.setState({ snapshot, family: snapshot.family });
    if (snapshot.latch !== null || snapshot.link.status !== 'ready') forgetWishes();
    if (snapshot.latch !== null) notices.takeBack(saidOfResume);
    if (becomesReady) notices.takeBackErrors(TRIED_ON);
  }

  function noteResumed(by: string): void {
    saidOfResume = words.stop.resumed({ name: personName(by, store.getState().snapshot.lease?.you ?? '') });
    notices.show('info', saidOfResume);
  }

  function noteProblem(error: unknown): void {
    forgetWishes();
    showError(error);
  }

  function showError(error: unknown): void {
    notices.ofBoard.showError(error);
    lateNotices.report(error);
  }

  /** `onIt`: the same in the board's own figures. False where it was refused, with a notice. */
  function send(targets: readonly ServoTarget[], onIt: readonly ServoTarget[], pace: Pace): boolean {
    if (session === null) return false;
    try {
      session.move(onIt, moveDurationMs(pace, targets, session.state.family, motions()));
      book.wish(targets);
      lateNotices.requested();
      return true;
    } catch (error) {
      notices.showError(error);
      return false;
    }
  }

  function drag(targets: readonly ServoTarget[], pace: Pace): boolean {
    const onIt = session === null ? null : gate.targets(targets);
    return onIt !== null && send(targets, onIt, pace);
  }

  async function detach(): Promise<void> {
    const former = session;
    unsubscribe();
    // Listeners still find where the robot was sent.
    store.setState(NOTHING);
    session = null;
    book.clear();
    traffic.note(INITIAL_STATE, clock.now(), store.getState().family.id);
    await former?.close();
  }

  function noteWay(way: Way): void {
    unsolicited = createUnsolicitedAnswers(() => notices.ofBoard.show('warning', words.link.sharedBoard));
    // A gateway's way has no label before its port is known.
    if (way.label === '' || nameOf(way) === boardName) return;
    boardName = nameOf(way);
    notices.boardLeft();
  }

  const verbs = createBoardVerbs({ session: () => session, ...{ gate, notices, lateNotices, showError } });

  return {
    ...verbs,
    store,
    traffic,
    clock,
    attach(next, way) {
      void detach();
      session = next;
      session.setAutoReconnect(autoReconnect);
      session.refuseRunsBelow(refusedBelowMv(robot()));
      store.setState({ way });
      noteWay(way);
      noteState(next.state);
      unsubscribe = next.subscribe({
        state: noteState,
        traffic(entry) {
          traffic.add(entry, next.state.family.id);
          unsolicited(entry);
        },
        problem: noteProblem,
        resumed: noteResumed,
        batteryUnknown: () => notices.ofBoard.show('info', words.battery.unknownAtRun),
      });
    },
    describe(described, way) {
      if (described !== session) return;
      store.setState({ way });
      noteWay(way);
    },
    detach,
    motions,
    motion: (servo) => motions()(servo),
    pose,
    isAtRest,
    refresh,
    waiting: book.waiting,
    move(targets, pace) {
      const isSent = drag(targets, pace);
      if (isSent) refresh();
      return isSent;
    },
    drag,
    calibrate(servo) {
      calibrated = servo;
      session?.calibrate(servo);
    },
    jog(position, durationMs) {
      if (calibrated === null) return;
      const targets = [{ servo: calibrated, position }];
      if (send(targets, onBoard(robot(), targets), durationMs)) refresh();
    },
    lease: (action) => session?.lease(action),
    keepRunning: (forMs) => session?.letRun(forMs),
    retryNow: () => session?.retryNow(),
    setAutoReconnect(enabled) {
      autoReconnect = enabled;
      session?.setAutoReconnect(enabled);
    },
  };
}
