// The slider of one servo of a robot that is driven over the broker: a native range input between the servo's limits. The thumb is the
// target, the bar below it the estimate. Knows no connection.

import { useRef, type CSSProperties, type KeyboardEvent } from 'react';
import type { Family } from '#shared/codec/families.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { words } from '../i18n/whole.ts';
import { cx } from '../ui/cx.ts';
import type { ServoPlace } from './pose.ts';
import styles from './Drive.module.css';

interface DriveSliderProps {
  readonly servo: RobotServo;
  readonly unit: Family['unit'];
  readonly place: ServoPlace;
  readonly isBlocked: boolean;
  /** `isLeap`: a jump to a position, not a drag towards it. */
  onMove(position: number, isLeap: boolean): void;
}

const STEP = 10;
const PAGE = 100;
/** A pointer that takes the track further from the thumb than this wants a jump. */
const LEAP_SHARE = 0.06;

export function DriveSlider({ servo, unit, place, isBlocked, onMove }: DriveSliderProps) {
  const { min, max, home, name } = servo;
  const { target, estimated } = place;
  const value = Math.min(max, Math.max(min, target ?? home));
  const gesture = useRef<'none' | 'drag' | 'leap'>('none');
  const label = name === '' ? words.servos.name({ servo: servo.servo }) : name;

  function moved(position: number): void {
    if (isBlocked) return;
    if (gesture.current === 'none')
      gesture.current = Math.abs(position - value) > (max - min) * LEAP_SHARE ? 'leap' : 'drag';
    onMove(position, gesture.current === 'leap');
  }

  function stepByKey(event: KeyboardEvent<HTMLInputElement>): void {
    const step = stepOf(event);
    if (step === 0) return;
    event.preventDefault();
    if (!isBlocked) onMove(Math.min(max, Math.max(min, value + step)), false);
  }

  return (
    <li className={cx(styles.servo, target === null && styles.unknown, isBlocked && styles.blocked)}>
      <span className={styles.name}>{label}</span>
      <span className={styles.target}>
        {target === null ? words.servos.unknown : words.position[unit]({ position: Math.round(target) })}
      </span>
      <span className={styles.track} style={shareStyle(estimated, min, max)}>
        <input
          type="range"
          aria-label={words.servos.position({ servo: servo.servo })}
          aria-valuetext={
            target === null
              ? words.servos.unknownValue
              : words.servoPanel.commanded({
                  position: words.position[unit]({ position: Math.round(target) }),
                })
          }
          aria-disabled={isBlocked}
          {...{ min, max, value }}
          step={1}
          onPointerDown={() => {
            gesture.current = 'none';
          }}
          onChange={({ target: input }) => moved(input.valueAsNumber)}
          onKeyDown={(event) => {
            gesture.current = ['Home', 'End'].includes(event.key) ? 'leap' : 'none';
            stepByKey(event);
          }}
        />
        {estimated !== null && <span className={styles.estimate} aria-hidden="true" />}
      </span>
    </li>
  );
}

/** The place of the estimate between the limits. */
function shareStyle(estimated: number | null, min: number, max: number): CSSProperties {
  const share = estimated === null ? 0 : Math.min(1, Math.max(0, (estimated - min) / (max - min)));
  return { ['--share' as string]: share.toFixed(4) };
}

function stepOf({ key, shiftKey }: KeyboardEvent): number {
  const arrow = shiftKey ? PAGE : STEP;
  return (
    {
      ...{ ArrowUp: arrow, ArrowRight: arrow, ArrowDown: -arrow, ArrowLeft: -arrow },
      ...{ PageUp: PAGE, PageDown: -PAGE },
    }[key] ?? 0
  );
}
