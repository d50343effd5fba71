// Two large buttons that a servo creeps by as long as one is held, and where it was sent to.

import { useEffect, useRef, useState } from 'react';
import { Button } from 'react-aria-components/Button';
import type { RobotServo } from '#shared/profile/robot.ts';
import type { Range } from '#shared/codec/families.ts';
import { Estimate } from '../../drive/Estimate.tsx';
import { scaleOf } from '../../drive/scale.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { useStores } from '../../stores.ts';
import { Mark } from '../../../ui/Chip.tsx';
import { Icon } from '../../../ui/Icon.tsx';
import { words } from '../../../i18n/whole.ts';
import type { Family } from '#shared/codec/families.ts';
import { startCreeping } from './creeping.ts';
import styles from './CreepControl.module.css';

export interface CreepControlProps {
  readonly servo: RobotServo;
  readonly reach: Range;
  readonly target: number;
  readonly unit: Family['unit'];
}

const WAYS = [
  { direction: -1, icon: 'minus', name: 'lower' },
  { direction: 1, icon: 'plus', name: 'higher' },
] as const;

export function CreepControl({ servo, reach, target, unit }: CreepControlProps) {
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
      className={styles.creep ?? ''}
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
