// The slider of a servo: a native range input between the servo's limits, on a track over the whole range of the board. The input
// itself is invisible: its marks are drawn on a canvas, and its value is written without React.

import { useRef, type KeyboardEvent } from 'react';
import type { RobotServo } from '#shared/profile/robot.ts';
import type { Range, Family } from '#shared/codec/families.ts';
import { cx } from '../../ui/cx.ts';
import { between, figuresAt, type Scale, stepped } from './scale.ts';
import type { Size, Pen, Look } from '../picture/Canvas.tsx';
import { Drawing } from '../picture/SharedSheet.tsx';
import { motionInFrame, targetOf, useSaidTarget } from '../picture/motion.ts';
import { fraction } from '../picture/pose.ts';
import { useStores } from '../stores.ts';
import { words } from '../../i18n/words.ts';
import { useDrag } from './useDrag.ts';
import styles from './PositionSlider.module.css';
import { MovingLabel } from '../picture/MovingText.tsx';

export interface Thumb {
  readonly width: number;
  readonly height: number;
}

/** In fractions of the track. */
export interface Marks {
  readonly target: number;
  readonly estimate: number | null;
  readonly isHeld: boolean;
  readonly isKnown: boolean;
  readonly isBlocked: boolean;
}

const BORDER = 2;
const CORNER = 4;
const BAR = { width: 3, height: 9, corner: 1 };
/** The bar begins within the thumb, so that there is no gap. */
const OVERLAP = 2;
const DASH = [4, 3];

export function thumbOf(element: Element): Thumb {
  const style = getComputedStyle(element);
  const lengthOf = (name: string): number => parseFloat(style.getPropertyValue(name));
  return { width: lengthOf('--thumb'), height: lengthOf('--thumb-height') };
}

export function paintMarks({ ctx, look, size }: Pen, thumb: Thumb, marks: Marks): void {
  const [way, middle] = [size.width - thumb.width, size.height / 2];
  if (marks.estimate !== null) {
    const left = thumb.width / 2 + marks.estimate * way - BAR.width / 2;
    ctx.fillStyle = look.estimated;
    ctx.beginPath();
    ctx.roundRect(left, middle + thumb.height / 2 - OVERLAP, BAR.width, BAR.height, BAR.corner);
    ctx.fill();
  }
  // Whole pixels have sharp edges.
  const left = Math.round(marks.target * way * devicePixelRatio) / devicePixelRatio;
  ctx.lineWidth = BORDER;
  ctx.strokeStyle = marks.isKnown ? look.commanded : look.unknown;
  ctx.setLineDash(marks.isKnown ? [] : DASH);
  ctx.beginPath();
  ctx.roundRect(
    left + BORDER / 2,
    middle - thumb.height / 2 + BORDER / 2,
    thumb.width - BORDER,
    thumb.height - BORDER,
    CORNER - BORDER / 2,
  );
  const ground = groundOf(look, marks);
  if (ground !== null) {
    ctx.fillStyle = ground;
    ctx.fill();
  }
  ctx.stroke();
}

function groundOf(look: Look, { isHeld, isBlocked }: Marks): string | null {
  if (isBlocked) return null;
  return isHeld ? look.commanded : look.raised;
}

interface LimitsProps {
  readonly servo: RobotServo;
  readonly range: Range;
  readonly scale: Scale;
}

/** The servo's limits as numbers near their places on the track, clear of each other and of the estimate. */
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

interface SliderMarksProps {
  readonly servo: number;
  /** The range of the whole track. */
  readonly range: Range;
  readonly isKnown: boolean;
  readonly isBlocked: boolean;
  thumbAt(): number;
  isHeld(): boolean;
}

/** The thumb is the target, the bar below it the estimate. On a canvas, because dozens of them change in each frame. */
function SliderMarks({ servo, range, isKnown, isBlocked, thumbAt, isHeld }: SliderMarksProps) {
  const { device } = useStores();
  const place = useRef<HTMLDivElement>(null);
  const measured = useRef<{ readonly size: Size; readonly thumb: Thumb } | null>(null);

  /** Measured from the style sheet again only when the slider's size changes. */
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
  /** The servo has a target, or the board has reported its position. */
  readonly isKnown: boolean;
  /** The position was reported by the board. */
  readonly isRead: boolean;
  /** A guess while the position is unknown. */
  readonly guess: number | null;
  readonly blocked: boolean;
  onMove(position: number): void;
  /** A jump to a position, by Home, End or a screen reader. */
  onLeap(position: number): void;
  /** A drag, reported also between two frames; the page shows it in the next frame. */
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
  const requested = (): number => targetOf(device, servo.servo) ?? guess ?? home;
  const write = (position: number): void => {
    if (input.current !== null) input.current.value = String(position);
  };

  const hold = useDrag(input, {
    shown: requested,
    drag: (position) => blocked || onDrag(position),
    release: () => write(requested()),
    pressTwice: () => blocked || onHome(),
  });
  useSaidTarget(servo.servo, (target) => {
    write(target ?? guess ?? home);
    if (input.current !== null) input.current.ariaValueText = valueText(scale, target, isRead, guess);
  });

  /** A blocked slider keeps the focus and its value. An input event without a pointer comes from Home or End. */
  function moved(element: HTMLInputElement): void {
    if (blocked || hold.current === 'brushed') element.value = String(requested());
    else if (hold.current === 'held') onDrag(element.valueAsNumber);
    else onLeap(element.valueAsNumber);
  }

  function stepByKey(event: KeyboardEvent<HTMLInputElement>): void {
    const change = keyStep(event, scale);
    if (change === 0) return;
    event.preventDefault();
    if (!blocked) onMove(stepped(scale, requested(), change));
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

/** The track, hatched outside the limits. */
function Track({ servo, range }: { readonly servo: RobotServo; readonly range: Range }) {
  return (
    <div
      className={cx(styles.rail, isNarrow(servo, range) && styles.narrow)}
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

/** Right and Up go to the right end of the slider. */
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

// The estimated position as a number; the slider's own value text says the commanded position.

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
