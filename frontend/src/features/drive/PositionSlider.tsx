// A native range input between the servo's limits, on a track as wide as the board allows. It is the control and has no picture
// of its own: its marks are drawn, and its value is written past React.

import { useRef, type KeyboardEvent } from 'react';
import { motionInFrame } from '../picture/motionInFrame.ts';
import { fraction } from '../picture/pose.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import type { Family, Range } from '#shared/codec/families.ts';
import { useStores } from '../stores.ts';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/words.ts';
import { Limits } from './Limits.tsx';
import { between } from './limitPlaces.ts';
import { stepped, type Scale } from './scale.ts';
import { SliderMarks } from './SliderMarks.tsx';
import { useDrag } from './useDrag.ts';
import { targetOf, useSaidTarget } from './useTarget.ts';
import styles from './PositionSlider.module.css';

export interface PositionSliderProps {
  readonly servo: RobotServo;
  readonly family: Family;
  readonly scale: Scale;
  /** It has been asked for something, or the board has said where it stands. */
  readonly isKnown: boolean;
  /** Its place is the board's own word. */
  readonly isRead: boolean;
  /** Where it may stand while nobody knows. */
  readonly guess: number | null;
  readonly blocked: boolean;
  onMove(position: number): void;
  /** At one stroke, with no hand that leads it there. */
  onLeap(position: number): void;
  /** While a pointer holds it, also between two frames: what is shown waits for the next one. */
  onDrag(position: number): void;
  onHome(): void;
}

export function PositionSlider({
  servo,
  family,
  scale,
  isKnown,
  isRead,
  guess,
  blocked,
  onMove,
  onLeap,
  onDrag,
  onHome,
}: PositionSliderProps) {
  const input = useRef<HTMLInputElement>(null);
  const { min, max, home } = servo;
  const { device } = useStores();
  const asked = (): number => targetOf(device, servo.servo) ?? guess ?? home;
  const write = (position: number): void => {
    if (input.current !== null) input.current.value = String(position);
  };

  const hold = useDrag(input, {
    shown: asked,
    drag: (position) => blocked || onDrag(position),
    release: () => write(asked()),
    pressTwice: () => blocked || onHome(),
  });
  useSaidTarget(servo.servo, (target) => {
    write(target ?? guess ?? home);
    if (input.current !== null) input.current.ariaValueText = valueText(scale, target, isRead, guess);
  });

  /** Blocked, it keeps the focus and its place, and takes nothing. Without a pointer on it, it was Home or End. */
  function moved(element: HTMLInputElement): void {
    if (blocked || hold.current === 'brushed') element.value = String(asked());
    else if (hold.current === 'held') onDrag(element.valueAsNumber);
    else onLeap(element.valueAsNumber);
  }

  function stepByKey(event: KeyboardEvent<HTMLInputElement>): void {
    const change = keyStep(event, scale);
    if (change === 0) return;
    event.preventDefault();
    if (!blocked) onMove(stepped(scale, asked(), change));
  }

  return (
    <div className={cx(styles.slider, blocked && styles.blocked, !isKnown && styles.unknown)}>
      <Track servo={servo} range={family.position} />
      {isNarrow(servo, family.position) && <Limits servo={servo} range={family.position} scale={scale} />}
      {guess !== null && <GuessMark share={fraction(guess, family.position)} />}
      <SliderMarks
        {...{ servo: servo.servo, range: family.position, isKnown, isBlocked: blocked }}
        thumbAt={() => motionInFrame(device, servo.servo).target ?? guess ?? home}
        isHeld={() => hold.current === 'held'}
      />
      <input
        ref={input}
        type="range"
        className={styles.input}
        style={between(servo, family.position)}
        aria-label={words.servos.position({ servo: servo.servo })}
        aria-disabled={blocked}
        min={min}
        max={max}
        step={1}
        defaultValue={home}
        onInput={(event) => moved(event.currentTarget)}
        onKeyDown={stepByKey}
      />
    </div>
  );
}

function valueText(scale: Scale, target: number | null, isRead: boolean, guess: number | null): string {
  if (target !== null)
    return (isRead ? words.servoPanel.reported : words.servoPanel.commanded)({
      position: scale.text(target),
    });
  return guess === null
    ? words.servos.unknownValue
    : words.firstMoves.guessedValue({ position: scale.text(guess) });
}

/** The way between the limits; beyond them hatched. */
function Track({ servo, range }: { readonly servo: RobotServo; readonly range: Range }) {
  return (
    <div
      className={cx(styles.lane, isNarrow(servo, range) && styles.narrow)}
      style={between(servo, range)}
      aria-hidden="true"
    >
      <div className={styles.track} />
      <div className={styles.home} style={{ insetInlineStart: percent(fraction(servo.home, servo)) }} />
    </div>
  );
}

const isNarrow = ({ min, max }: Range, range: Range): boolean => min > range.min || max < range.max;

function GuessMark({ share }: { readonly share: number }) {
  return (
    <div className={styles.whole} aria-hidden="true">
      <div className={styles.guess} style={{ insetInlineStart: percent(share) }} />
    </div>
  );
}

const percent = (share: number): string => `${(share * 100).toFixed(2)}%`;

/** Right and up are the right end of the slider. */
function keyStep({ key, shiftKey }: KeyboardEvent, { step, page, direction }: Scale): number {
  const arrow = step * (shiftKey ? 10 : 1);
  const towards =
    {
      ArrowUp: arrow,
      ArrowRight: arrow,
      ArrowDown: -arrow,
      ArrowLeft: -arrow,
      PageUp: page,
      PageDown: -page,
    }[key] ?? 0;
  return towards * direction;
}
