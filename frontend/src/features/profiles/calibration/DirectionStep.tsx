// The person confirms whether the servo turned in the direction of the arrow: after a move home that is long enough, or after a small turn away from home
// and back, towards the side with more room.

import { useEffect, useRef, useState } from 'react';
import { changeServo } from '#shared/profile/robotEdits.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { useTarget } from '../../picture/motion.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useDevice, useStores } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { Answer, Ask, sightOf, type CurrentCalibration } from './StepParts.tsx';
import styles from './CalibrationWizard.module.css';
import type { Clock } from '#shared/clock.ts';
import type { ServoMotion } from '#shared/robot/state.ts';

interface At {
  readonly at: CurrentCalibration;
}

export function DirectionStep({ at }: At) {
  const away = awayFrom(at.servo);
  return away === null ? <TooLittleRoom at={at} /> : <TurnAndAsk at={at} away={away} />;
}

function TooLittleRoom({ at: { robot, servo, isFinished, keep, go } }: At) {
  const { unit } = FAMILIES[robot.board];
  return (
    <>
      <Ask>
        {words.calibration.tooLittleRoom({
          min: servo.min,
          max: words.position[unit]({ position: servo.max }),
        })}
      </Ask>
      <div className={styles.actions}>
        <Answer tone={isFinished ? 'plain' : 'primary'} onPress={() => go(servo.servo, 'min')}>
          {words.calibration.setEnds}
        </Answer>
        {!isFinished && (
          <Answer tone="quiet" onPress={keep}>
            {words.calibration.leaveAsIs}
          </Answer>
        )}
      </div>
    </>
  );
}

function TurnAndAsk({ at: { robot, servo, accept }, away }: At & { readonly away: number }) {
  const { device } = useStores();
  const { phase, turn } = useTurning(servo, away);
  const target = useTarget(servo.servo);
  const [side] = useState(() => homeward(servo, { target, estimated: device.motion(servo.servo).estimated }));
  const isMoving = useDevice((state) => state.isMoving);
  // The start of a move is reported a moment later.
  const { estimated } = device.motion(servo.servo);
  const isOnItsWay = isMoving || Math.abs((estimated ?? servo.home) - servo.home) > 1;
  const isTurning = phase === 'away' || phase === 'back';
  const isAway = target !== servo.home && !isTurning;
  const shows = isAway ? 'nothing' : phase === null && side !== 0 ? 'wayHome' : 'turn';
  // The direction has been visible; the servo returns home whatever the answer is.
  const isAsked = shows === 'wayHome' || (shows === 'turn' && (phase === 'back' || phase === 'done'));
  const way = (shows === 'wayHome' ? side : sideOf(servo)) > 0 ? 'right' : 'left';
  const { unit } = FAMILIES[robot.board];
  const from = sightOf(robot, servo);
  const sight = words.calibration.sights[from];
  const sentence = {
    nothing: words.calibration.homeFirst({
      at: target ?? servo.home,
      home: words.position[unit]({ position: servo.home }),
    }),
    wayHome: sight.homeward,
    turn: sight.about,
  };
  const question = { nothing: '', wayHome: sight.askedHomeward[way], turn: sight.asked[way] };
  const answer = (isReversed: boolean) => () =>
    accept((all) => changeServo(all, servo.servo, { isReversed }));
  return (
    <>
      <Ask>{sentence[shows]}</Ask>
      {from !== 'gripper' && (
        <div className={styles.arrow}>
          {(shows === 'wayHome' || phase === 'away') && <TurnArrow isClockwise={way === 'right'} />}
        </div>
      )}
      <div className={styles.actions}>
        {isAway ? (
          <Answer tone="primary" onPress={() => device.jog(servo.home, GENTLE_MOVE_MS)}>
            {words.calibration.goTo({ at: words.position[unit]({ position: servo.home }) })}
          </Answer>
        ) : (
          <Answer tone={isAsked ? 'plain' : 'primary'} isPending={isTurning || isOnItsWay} onPress={turn}>
            {words.calibration.turn}
          </Answer>
        )}
      </div>
      <p className={styles.requested}>{isAsked ? question[shows] : ''}</p>
      <div className={styles.actions}>
        <Answer tone={isAsked ? 'primary' : 'plain'} isDisabled={!isAsked} onPress={answer(false)}>
          {words.calibration.same}
        </Answer>
        <Answer isDisabled={!isAsked} onPress={answer(true)}>
          {words.calibration.other}
        </Answer>
      </div>
    </>
  );
}

function useTurning(servo: RobotServo, away: number): { readonly phase: TurnPhase | null; turn(): void } {
  const { device } = useStores();
  const [phase, setPhase] = useState<TurnPhase | null>(null);
  const end = useRef<() => void>(() => undefined);
  useEffect(() => () => end.current(), []);
  return {
    phase,
    turn() {
      end.current();
      end.current = startTurning(
        {
          clock: device.clock,
          motion: () => device.motion(servo.servo),
          mayMove: () => motionHindrance(device.store.getState().snapshot) === null,
          move: device.jog,
        },
        { home: servo.home, away },
        setPhase,
      );
    },
  };
}

/** A horn with an arrow in the direction of its turn. */
function TurnArrow({ isClockwise }: { readonly isClockwise: boolean }) {
  return (
    <svg viewBox="-60 -60 120 76" role="img" aria-label={words.calibration.arrow}>
      <g transform={isClockwise ? '' : 'scale(-1 1)'}>
        <path className={styles.horn} d="M-9 0L-4 -40a4 4 0 0 1 8 0L9 0A9 9 0 0 1 -9 0z" />
        <path className={styles.turn} d="M-36 -36A51 51 0 0 1 34 -38M34 -38l-4 -14M34 -38l-14 1" />
      </g>
    </svg>
  );
}

interface Turning {
  readonly clock: Clock;
  motion(): ServoMotion;
  mayMove(): boolean;
  move(position: number, durationMs: number): void;
}

/** `ended`: something else moved or stopped the servo. */
export type TurnPhase = 'away' | 'back' | 'done' | 'ended';

const SHARE_OF_SIDE = 0.3;
/** The smallest turn of a horn that is visible. */
const SEEN_DEGREES = 3;

/** The side of home that has more room. */
const sideOf = ({ min, home, max }: RobotServo): 1 | -1 => (max - home >= home - min ? 1 : -1);

/** A position on that side that is far enough to be visible; null if the limits leave no room. */
export function awayFrom(servo: RobotServo): number | null {
  const room = Math.max(servo.max - servo.home, servo.home - servo.min);
  const seen = Math.ceil(SEEN_DEGREES / servo.degreesPerUnit);
  if (room < seen) return null;
  return Math.round(servo.home + sideOf(servo) * Math.max(room * SHARE_OF_SIDE, seen));
}

/** The direction of a move home that is long enough to be visible, otherwise 0. */
export function homeward(
  { home, degreesPerUnit }: RobotServo,
  { target, estimated }: Pick<ServoMotion, 'target' | 'estimated'>,
): 1 | 0 | -1 {
  const way = target === home && estimated !== null ? home - estimated : 0;
  if (Math.abs(way) * degreesPerUnit < SEEN_DEGREES) return 0;
  return way > 0 ? 1 : -1;
}

const TURN_MS = 900;
/** A pause before it returns. */
const STAND_MS = 400;
const LOOK_EACH_MS = 50;

/** Turns the servo away from home and back. Returns a function that ends it and may be called twice. */
export function startTurning(
  { clock, motion, mayMove, move }: Turning,
  { home, away }: { readonly home: number; readonly away: number },
  hear: (phase: TurnPhase) => void,
): () => void {
  let cancel = (): void => undefined;

  function go(to: number, phase: TurnPhase, then: () => void): void {
    if (!mayMove()) return hear('ended');
    hear(phase);
    move(to, TURN_MS);
    cancel = clock.after(TURN_MS, () => untilThere(to, then));
  }

  function untilThere(to: number, then: () => void): void {
    const { target, estimated } = motion();
    if (!mayMove() || (target !== null && Math.abs(target - to) > 1)) return hear('ended');
    cancel =
      target === estimated
        ? clock.after(STAND_MS, then)
        : clock.after(LOOK_EACH_MS, () => untilThere(to, then));
  }

  go(away, 'away', () => go(home, 'back', () => hear('done')));
  return () => cancel();
}
