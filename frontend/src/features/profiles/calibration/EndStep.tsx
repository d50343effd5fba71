// Lowest, highest and home: the servo is crept there and the commanded position becomes the figure.

import { useEffect, useRef, useState } from 'react';
import { Button } from 'react-aria-components/Button';
import type { RobotServo } from '#shared/profile/robot.ts';
import { type Range, type Family, FAMILIES } from '#shared/codec/families.ts';
import type { Calibration } from '#shared/profile/calibration.ts';
import { endFound, noteFound, changeServo, reachOf } from '#shared/profile/robotEdits.ts';
import { Estimate } from '../../drive/Estimate.tsx';
import { scaleOf } from '../../drive/scale.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useStores } from '../../stores.ts';
import { Mark } from '../../../ui/Chip.tsx';
import { Icon } from '../../../ui/Icon.tsx';
import { words } from '../../../i18n/whole.ts';
import { startCreeping } from './creeping.ts';
import { ReachBar } from '../ReachBar.tsx';
import { GENTLE_MOVE_MS } from '../../../robot/moveTime.ts';
import { useTarget } from '../../drive/useTarget.ts';
import { Answer, Ask } from './Answer.tsx';
import { sightOf, type CurrentCalibration } from './useCalibration.ts';
import creepControlStyles from './CreepControl.module.css';
import styles from './CalibrationWizard.module.css';

// Two large buttons that a servo creeps by as long as one is held, and where it was sent to.

interface CreepControlProps {
  readonly servo: RobotServo;
  readonly reach: Range;
  readonly target: number;
  readonly unit: Family['unit'];
}

const WAYS = [
  { direction: -1, icon: 'minus', name: 'lower' },
  { direction: 1, icon: 'plus', name: 'higher' },
] as const;

function CreepControl({ servo, reach, target, unit }: CreepControlProps) {
  const { start, end } = useCreeping(servo.servo, reach);
  const scale = scaleOf(servo, { unit }, 'board');
  // Told when a button is let go, not at each of the many steps.
  const [said, setSaid] = useState('');
  const value = scale.text(target);

  function letGo(): void {
    end();
    setSaid(value);
  }

  const [lower, higher] = WAYS.map(({ direction, icon, name }) => (
    <Button
      key={name}
      className={creepControlStyles.creep ?? ''}
      aria-label={words.calibration[name]}
      onPressStart={() => start(direction)}
      onPressEnd={letGo}
    >
      <Icon name={icon} />
    </Button>
  ));
  return (
    <div className={creepControlStyles.control}>
      {lower}
      <div className={creepControlStyles.now}>
        <output
          className={creepControlStyles.value}
          aria-label={words.calibration.now}
          aria-live="off"
          title={words.truth.commanded}
        >
          <Mark truth="commanded" /> {value}
        </output>
        <Estimate servo={servo.servo} scale={scale} />
      </div>
      {higher}
      <p className={creepControlStyles.said} role="status">
        {said}
      </p>
    </div>
  );
}

interface Creep {
  start(direction: 1 | -1): void;
  end(): void;
}

/** A page that goes out of sight has let go. */
function useCreeping(servo: number, reach: Range): Creep {
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
      ending.current = startCreeping(
        { clock: device.clock, reach, motion, mayMove, move: device.creep },
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
  // A servo that has just been crept to an end seldom rests there.
  const isHomeUnchanged = end === 'home' && (target <= servo.min || target >= servo.max);
  const isAwayFromHome = end === 'home' && target !== servo.home;
  const endsFor = sightOf(robot, servo) === 'gripper' ? 'gripperEnds' : 'ends';
  const keepAndGo = (): void => {
    device.creep(servo.home, GENTLE_MOVE_MS);
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
      <CreepControl servo={servo} reach={reach} target={target} unit={unit} />
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

/** An end pushed it; empty where none did. */
function movedHome({ found }: Calibration, { servo, home }: RobotServo): string {
  return found?.servo === servo && found.home !== home
    ? words.calibration.homeMoved({ from: found.home, to: home })
    : '';
}
