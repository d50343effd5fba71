// What the steps of the calibration share: its state (servo, step, the robot so far; each finished step is one undo step), the question,
// its answers, and what is shown before a servo may move.

import { type ReactNode, useLayoutEffect, useRef, useState, type MouseEvent, useEffect } from 'react';
import { type Robot, type RobotServo, flawOf, servoOf } from '#shared/profile/robot.ts';
import {
  reachOf,
  beginCalibration,
  isServoDone,
  partnerDone,
  servoDone,
  settled,
  stepDone,
} from '#shared/profile/robotEdits.ts';
import { isWatching, mayResume, type Lease } from '#shared/robot/lease.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useDevice, useSnapshot, useStores, useRobot, useServoView, useView } from '../../stores.ts';
import { leaseTextOf } from '../../people/LeaseChip.tsx';
import { mayResumeText, servoLabel } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import styles from './CalibrationWizard.module.css';
import type { Calibration, CalibrationStep } from '#shared/profile/calibration.ts';
import { JOINT } from '../../picture/pose.ts';
import { robotFlawSentence } from '../../../i18n/robotFlaws.ts';

/** The view from which the turn of a servo is visible on the arm. Other bodies have only the horn. */
export type Sight = 'gripper' | 'side' | 'above' | 'front' | 'horn';

const ARM_SIGHTS: Readonly<Record<number, Sight>> = {
  [JOINT.gripper]: 'gripper',
  [JOINT.roll]: 'front',
  [JOINT.wrist]: 'side',
  [JOINT.elbow]: 'side',
  [JOINT.shoulder]: 'side',
  [JOINT.base]: 'above',
};

export const sightOf = ({ body }: Robot, { servo }: RobotServo): Sight =>
  (body === 'arm' ? ARM_SIGHTS[servo] : undefined) ?? 'horn';

export interface CurrentCalibration {
  readonly robot: Robot;
  readonly servo: RobotServo;
  readonly progress: Calibration;
  /** Why the last edit was refused. */
  readonly problem: string;
  /** All servos are done. */
  readonly isFinished: boolean;
  go(servo: number, step: CalibrationStep): void;
  /** Applies the edit and continues; if the edit is invalid, stays and says why. */
  accept(edit: (robot: Robot) => Robot, more?: More): void;
  /** Continues without an edit. */
  keep(): void;
  /** Continues with the next servo. */
  skipServo(): void;
}

export interface More {
  /** The servo on the other side that got all results. */
  readonly partner?: number;
  /** Adds information for later steps. */
  note?(progress: Calibration): Calibration;
}

/** The progress for each state of a robot, so that undo also undoes progress. */
const reached = new WeakMap<Robot, Calibration>();

export function useCalibration(): CurrentCalibration {
  const { view, robots } = useStores();
  const robot = useRobot();
  const robotId = robots.current().id;
  const saved = useView(({ calibration }) => calibration);
  const selected = useServoView(({ selected }) => selected.at(-1) ?? null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const latest = reached.get(robot) ?? (saved?.robotId === robotId ? saved.progress : null);
  const begun = latest === null ? beginCalibration(robot, selected) : settled(robot, latest);
  const servo = servoOf(robot, begun.servo);
  if (servo === undefined) throw new Error('a settled calibration has its servo');
  useLimitsLifted(servo.servo);

  function put(progress: Calibration): void {
    setProblem(null);
    reached.set(robots.current().robot, progress);
    view.setState({ calibration: { robotId, progress } });
  }

  return {
    ...{ robot, servo, progress: begun },
    problem: problem?.robot === robot ? problem.text : '',
    isFinished: robot.servos.every((one) => isServoDone(begun, one)),
    go: (to, step) => put({ ...begun, servo: to, step }),
    accept(edit, { partner, note = (progress: Calibration) => progress } = {}) {
      const flaw = flawOf(edit(robot));
      if (flaw !== null) {
        setProblem({ robot, text: robotFlawSentence(flaw) });
        return;
      }
      reached.set(robot, begun);
      robots.edit(() => words.calibration.undo[begun.step]({ servo: servoLabel(servo) }), edit);
      const next = edit(robot);
      const noted = note(begun);
      put(partner === undefined ? stepDone(next, noted) : partnerDone(next, noted, partner));
    },
    keep: () => put(stepDone(robot, begun)),
    skipServo: () => put(servoDone(robot, begun)),
  };
}

/** Belongs to one state of the robot and disappears with it. */
interface Problem {
  readonly robot: Robot;
  readonly text: string;
}

/** Lifts the limits of this servo only, while it is calibrated. */
function useLimitsLifted(servo: number): void {
  const { device } = useStores();
  useEffect(() => {
    device.calibrate(servo);
    return () => device.calibrate(null);
  }, [device, servo]);
}

/** The current question. It takes the focus when a step ends and its buttons disappear, so that the focus is not on a button that moves. */
export function Ask({ children }: { readonly children: ReactNode }) {
  const requested = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    if (document.activeElement?.contains(requested.current)) requested.current?.focus();
  }, []);
  return (
    <p ref={requested} className={styles.ask} tabIndex={-1}>
      {children}
    </p>
  );
}

/** The usual limit of systems for a double press. */
const READ_MS = 500;

interface AnswerProps extends Omit<ButtonProps, 'onPress'> {
  onPress(): void;
}

export function Answer({ onPress, ...rest }: AnswerProps) {
  const { clock } = useStores().device;
  const [shownMs] = useState(clock.now);

  function isEcho({ detail, nativeEvent }: MouseEvent): boolean {
    const isFinger = nativeEvent instanceof PointerEvent && nativeEvent.pointerType === 'touch';
    return isFinger ? clock.now() - shownMs < READ_MS : detail > 1;
  }

  return (
    <span className={styles.answer}>
      <Button
        {...rest}
        onPress={(press) => {
          if (!isEcho(press)) onPress();
        }}
      />
    </span>
  );
}

export interface MotionGateProps {
  readonly robot: Robot;
  readonly servo: RobotServo;
  readonly children: ReactNode;
}

export function MotionGate({ robot, servo, children }: MotionGateProps) {
  const { device } = useStores();
  const hindrance = useSnapshot(motionHindrance);
  const lease = useSnapshot((snapshot) => snapshot.lease);
  const known = useDevice((state) => state.known);
  const isKnown = known.includes(servo.servo);
  const homes = robot.servos
    .filter((one) => !known.includes(one.servo))
    .map((one) => ({ servo: one.servo, position: one.home }));
  if (hindrance === 'latched') {
    return (
      <>
        <Ask>{words.calibration.stopped}</Ask>
        {lease === null || mayResume(lease) ? (
          <Answer tone="primary" onPress={device.resume}>
            {words.stop.resume}
          </Answer>
        ) : (
          <p>{mayResumeText(lease)}</p>
        )}
      </>
    );
  }
  if (hindrance !== null) {
    return (
      <>
        <Ask>{words.servos.blocked[hindrance]}</Ask>
        {lease !== null && isWatching(lease) && <LeaseActions lease={lease} />}
      </>
    );
  }
  if (isKnown) return children;
  return (
    <>
      <Ask>{words.calibration.unknown}</Ask>
      <Answer tone="primary" onPress={() => device.jog(middleOf(robot, servo), GENTLE_MOVE_MS)}>
        {words.calibration.goHome}
      </Answer>
      {homes.length > 1 && (
        <Answer onPress={() => device.move(homes, GENTLE_MOVE_MS)}>
          {words.calibration.allHome({ count: homes.length })}
        </Answer>
      )}
    </>
  );
}

/** The actions about the lease, as in the status line behind this dialog. */
function LeaseActions({ lease }: { readonly lease: Lease }) {
  const { device } = useStores();
  return leaseTextOf(lease).acts.map(({ label, wish, ...how }) => (
    <Answer key={label} {...how} onPress={() => device.lease(wish)}>
      {label}
    </Answer>
  ));
}

function middleOf(robot: Robot, servo: RobotServo): number {
  const { min, max } = reachOf(robot, servo);
  return Math.min(max, Math.max(min, FAMILIES[robot.board].centre - servo.trim));
}
