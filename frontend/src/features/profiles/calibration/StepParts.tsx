// What the steps of the calibration share: the question, its answers, and what is shown before a servo may move.

import { type ReactNode, useLayoutEffect, useRef, useState, type MouseEvent } from 'react';
import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import { reachOf } from '#shared/profile/robotEdits.ts';
import { isWatching, mayResume, type Lease } from '#shared/robot/lease.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useDevice, useSnapshot, useStores } from '../../stores.ts';
import { leaseTextOf } from '../../people/leaseText.ts';
import { mayResumeText } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import styles from './CalibrationWizard.module.css';

/** The current question. It takes the focus when a step ends and its buttons disappear, so that the focus is not on a button that moves. */
export function Ask({ children }: { readonly children: ReactNode }) {
  const asked = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    if (document.activeElement?.contains(asked.current)) asked.current?.focus();
  }, []);
  return (
    <p ref={asked} className={styles.ask} tabIndex={-1}>
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
