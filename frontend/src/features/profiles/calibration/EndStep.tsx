// The steps for lowest, highest and home: the servo is jogged there, and its target becomes the value.

import { useEffect, useRef, useState } from 'react';
import { Button } from 'react-aria-components/Button';
import type { RobotServo } from '#shared/profile/robot.ts';
import { type Range, type Family, FAMILIES } from '#shared/codec/families.ts';
import type { Calibration } from '#shared/profile/calibration.ts';
import { endFound, noteFound, changeServo, reachOf } from '#shared/profile/robotEdits.ts';
import { Estimate } from '../../drive/PositionSlider.tsx';
import { scaleOf } from '../../drive/scale.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useStores } from '../../stores.ts';
import { Mark } from '../../../ui/Chip.tsx';
import { Icon } from '../../../ui/Icon.tsx';
import { words } from '../../../i18n/whole.ts';
import { ReachBar } from '../RobotPicture.tsx';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { useTarget } from '../../picture/motion.ts';
import { Answer, Ask, sightOf, type CurrentCalibration } from './StepParts.tsx';
import styles from './CalibrationWizard.module.css';
import type { Clock } from '#shared/clock.ts';
import type { ServoMotion } from '#shared/robot/state.ts';

interface JogControlProps {
  readonly servo: RobotServo;
  readonly reach: Range;
  readonly target: number;
  readonly unit: Family['unit'];
}

const WAYS = [
  { direction: -1, icon: 'minus', name: 'lower' },
  { direction: 1, icon: 'plus', name: 'higher' },
] as const;

/** Two large buttons that move the servo while they are held, and its target. */
function JogControl({ servo, reach, target, unit }: JogControlProps) {
  const { start, end } = useJogging(servo.servo, reach);
  const scale = scaleOf(servo, { unit }, 'board');
  // Reported to screen readers when a button is released, not at each step.
  const [said, setSaid] = useState('');
  const value = scale.text(target);

  function letGo(): void {
    end();
    setSaid(value);
  }

  const [lower, higher] = WAYS.map(({ direction, icon, name }) => (
    <Button
      key={name}
      className={styles.jog ?? ''}
      aria-label={words.calibration[name]}
      onPressStart={() => start(direction)}
      onPressEnd={letGo}
    >
      <Icon name={icon} />
    </Button>
  ));
  return (
    <div className={styles.control}>
      {lower}
      <div className={styles.now}>
        <output
          className={styles.value}
          aria-label={words.calibration.now}
          aria-live="off"
          title={words.truth.commanded}
        >
          <Mark truth="commanded" /> {value}
        </output>
        <Estimate servo={servo.servo} scale={scale} />
      </div>
      {higher}
      <p className={styles.said} role="status">
        {said}
      </p>
    </div>
  );
}

interface Jog {
  start(direction: 1 | -1): void;
  end(): void;
}

/** Hiding the page counts as releasing the button. */
function useJogging(servo: number, reach: Range): Jog {
  const { device } = useStores();
  const ending = useRef<() => void>(() => undefined);
  const end = (): void => ending.current();

  useEffect(() => {
    window.addEventListener('blur', end);
    return () => {
      window.removeEventListener('blur', end);
      end();
    };
  }, []);

  return {
    end,
    start(direction) {
      end();
      const motion = () => device.motion(servo);
      const mayMove = (): boolean => motionHindrance(device.store.getState().snapshot) === null;
      ending.current = startJogging(
        { clock: device.clock, reach, motion, mayMove, move: device.jog },
        direction,
      );
    },
  };
}

interface EndStepProps {
  readonly at: CurrentCalibration;
  readonly end: 'min' | 'max' | 'home';
}

export function EndStep({ at, end }: EndStepProps) {
  const { robot, servo, progress, isFinished, keep } = at;
  const { device } = useStores();
  const target = useTarget(servo.servo);
  const { unit } = FAMILIES[robot.board];
  const reach = reachOf(robot, servo);
  if (target === null) return null;
  // A servo that was just jogged to a limit is rarely at home there.
  const isHomeUnchanged = end === 'home' && (target <= servo.min || target >= servo.max);
  const isAwayFromHome = end === 'home' && target !== servo.home;
  const endsFor = sightOf(robot, servo) === 'gripper' ? 'gripperEnds' : 'ends';
  const keepAndGo = (): void => {
    device.jog(servo.home, GENTLE_MOVE_MS);
    keep();
  };
  const [setTone, keepTone] = isFinished
    ? (['plain', 'quiet'] as const)
    : isHomeUnchanged
      ? (['plain', 'primary'] as const)
      : (['primary', 'quiet'] as const);
  return (
    <>
      <Ask>{words.calibration[endsFor][end]}</Ask>
      <JogControl servo={servo} reach={reach} target={target} unit={unit} />
      <ReachBar servo={servo} reach={reach} unit={unit} />
      <p className={styles.dim}>
        {words.calibration.limitsNow({ ...servo, unit: words.units[unit] })}{' '}
        {words.calibration.past({ min: reach.min, max: reach.max, unit: words.units[unit] })}{' '}
        {movedHome(progress, servo)}
      </p>
      <div className={styles.actions}>
        <Answer tone={setTone} onPress={() => take(at, end, target)}>
          {words.calibration.set[end]}
        </Answer>
        <Answer tone={keepTone} onPress={isAwayFromHome ? keepAndGo : keep}>
          {isAwayFromHome
            ? words.calibration.keepAndGo({ at: words.position[unit]({ position: servo.home }) })
            : words.calibration.keep({ at: words.position[unit]({ position: servo[end] }) })}
        </Answer>
      </div>
    </>
  );
}

function take({ servo, progress, accept }: CurrentCalibration, end: EndStepProps['end'], at: number): void {
  if (end === 'home') accept((all) => changeServo(all, servo.servo, { home: at }));
  else
    accept((all) => endFound(all, progress, servo, end, at), {
      note: (before) => noteFound(before, servo, end, at),
    });
}

/** Says that a new limit has moved home; empty if not. */
function movedHome({ found }: Calibration, { servo, home }: RobotServo): string {
  return found?.servo === servo && found.home !== home
    ? words.calibration.homeMoved({ from: found.home, to: home })
    : '';
}

interface Jogging {
  readonly clock: Clock;
  /** The range of the board. */
  readonly reach: Range;
  motion(): ServoMotion;
  mayMove(): boolean;
  move(position: number, durationMs: number): void;
}

const STEP_MS = 100;
/** Longer than a tap. */
const HOLD_AFTER_MS = 350;
/** After this number of steps it moves faster. Half the speed of a pad, which is slow enough to release in time. */
const FASTER_AFTER_STEPS = 12;
const FASTER = 2;
const STEPS_A_RANGE = 100;
const NUDGES_A_STEP = 4;

/**
 * Jogs a servo while a button is held: a small step at once, then a tenth of the range per second, later twice that. Each step waits for
 * the estimate, so that the servo stops soon after the release. Returns a function that ends it and may be called twice.
 */
export function startJogging(
  { clock, reach, motion, mayMove, move }: Jogging,
  direction: 1 | -1,
): () => void {
  const step = (reach.max - reach.min) / STEPS_A_RANGE;
  let taken = 0;
  let cancel = (): void => undefined;

  function go(way: number): void {
    const { target, estimated } = motion();
    if (target === null || estimated === null || Math.abs(target - estimated) > 2 * Math.max(way, step))
      return;
    const next = Math.round(target) + direction * Math.max(1, Math.round(way));
    const within = Math.min(reach.max, Math.max(reach.min, next));
    if (within === target) return;
    taken += 1;
    move(within, STEP_MS);
  }

  function jog(): void {
    if (!mayMove()) return;
    go(taken > FASTER_AFTER_STEPS ? FASTER * step : step);
    cancel = clock.after(STEP_MS, jog);
  }

  if (mayMove()) {
    go(step / NUDGES_A_STEP);
    cancel = clock.after(HOLD_AFTER_MS, jog);
  }
  return () => cancel();
}
