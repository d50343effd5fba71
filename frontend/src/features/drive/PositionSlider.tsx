// A native range input between the servo's limits, on a track as wide as the board allows. It is the control and has no picture
// of its own: its marks are drawn, and its value is written past React.

import { useRef, type KeyboardEvent } from 'react';
import type { RobotServo } from '#shared/profile/robot.ts';
import type { Range, Family } from '#shared/codec/families.ts';
import { cx } from '../../ui/cx.ts';
import { between, figuresAt, type Scale, stepped } from './scale.ts';
import type { Size } from '../picture/Canvas.tsx';
import { Drawing } from '../picture/SharedSheet.tsx';
import { motionInFrame, targetOf, useSaidTarget } from '../picture/motion.ts';
import { fraction } from '../picture/pose.ts';
import { useStores } from '../stores.ts';
import { paintMarks, thumbOf, type Thumb } from './paintMarks.ts';
import { words } from '../../i18n/words.ts';
import { useDrag } from './useDrag.ts';
import styles from './PositionSlider.module.css';
import { MovingLabel } from '../picture/MovingText.tsx';

// A servo's limits in figures, at the ends of the way between them, or as near as they have room beside each other
// and the estimate.

interface LimitsProps {
  readonly servo: RobotServo;
  readonly range: Range;
  readonly scale: Scale;
}

function Limits({ servo, range, scale }: LimitsProps) {
  const ends = [scale.digits(servo.min), scale.digits(servo.max)] as const;
  return (
    <div
      className={cx(styles.limits, styles[figuresAt(servo, range, ends)])}
      style={between(servo, range)}
      aria-hidden="true"
    >
      {ends.map((end, index) => (
        <span key={index}>{end}</span>
      ))}
    </div>
  );
}

// The marks that move on a slider: the thumb is the target, the bar below it the estimate. On a canvas, because
// dozens of them change in each frame.

interface SliderMarksProps {
  readonly servo: number;
  /** From the track's one end to its other. */
  readonly range: Range;
  readonly isKnown: boolean;
  readonly isBlocked: boolean;
  thumbAt(): number;
  isHeld(): boolean;
}

function SliderMarks({ servo, range, isKnown, isBlocked, thumbAt, isHeld }: SliderMarksProps) {
  const { device } = useStores();
  const place = useRef<HTMLDivElement>(null);
  const measured = useRef<{ readonly size: Size; readonly thumb: Thumb } | null>(null);

  /** Its measures are the style sheet's, and another only where the size of all of it is. */
  function thumbIn(size: Size): Thumb | null {
    if (place.current === null) return null;
    if (measured.current?.size !== size) measured.current = { size, thumb: thumbOf(place.current) };
    return measured.current.thumb;
  }

  return (
    <div ref={place} className={styles.marks}>
      <Drawing
        className={styles.canvas}
        shown={() => {
          const { estimated } = motionInFrame(device, servo);
          const estimate = estimated === null ? null : fraction(estimated, range);
          return [fraction(thumbAt(), range), estimate, isHeld(), isKnown, isBlocked] as const;
        }}
        paint={(pen, [target, estimate, isHeldNow, isKnownNow, isBlockedNow]) => {
          const thumb = thumbIn(pen.size);
          const state = { isHeld: isHeldNow, isKnown: isKnownNow, isBlocked: isBlockedNow };
          if (thumb !== null) paintMarks(pen, thumb, { target, estimate, ...state });
        }}
      />
    </div>
  );
}

interface PositionSliderProps {
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

// The estimated position as a number; the slider's own value text says what was asked.

export function Estimate({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const text = (): string => {
    const { estimated } = motionInFrame(device, servo);
    return estimated === null ? '' : words.servoPanel.estimated({ position: scale.digits(estimated) });
  };
  return (
    <MovingLabel text={text} colour="estimated" className={styles.estimate} title={words.truth.estimated} />
  );
}
