// A native range input between the servo's limits, on a track as wide as the board allows, with two marks: the thumb is the
// target, the bar below it the estimate. The input is uncontrolled so that a finger on it is never pushed about by what
// the session says meanwhile.

import { useRef, type KeyboardEvent } from 'react';
import { fraction } from '../body/pose.ts';
import { useMotion } from '../body/useMotion.ts';
import type { RobotServo } from '#shared/actions/robot/robot.ts';
import type { Family, Range } from '#shared/protocol/families.ts';
import { useStores } from '../stores/stores.ts';
import { cx } from '../ui/cx.ts';
import { setAttribute } from '../ui/setAttribute.ts';
import { words } from '../words/words.ts';
import { Limits } from './Limits.tsx';
import { between } from './limitPlaces.ts';
import { stepped, type Scale } from './scale.ts';
import { useRawDrag } from './useRawDrag.ts';
import { useReadableTarget, useTarget } from './useTarget.ts';
import styles from './PositionSlider.module.css';

export interface PositionSliderProps {
  readonly servo: RobotServo;
  readonly family: Family;
  readonly scale: Scale;
  /** It has been asked for something. */
  readonly isKnown: boolean;
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
  guess,
  blocked,
  onMove,
  onLeap,
  onDrag,
  onHome,
}: PositionSliderProps) {
  const input = useRef<HTMLInputElement>(null);
  const held = useRef(false);
  const { min, max, home } = servo;
  const { device } = useStores();
  const shown = (): number => device.targetsNow()[servo.servo] ?? guess ?? home;

  useRawDrag(input, (position) => blocked || onDrag(position));
  // Past React: dozens of them may change in each frame.
  useTarget(servo.servo, (target) => {
    if (input.current !== null && !held.current) input.current.value = String(target ?? guess ?? home);
  });
  useReadableTarget(servo.servo, (target) => {
    if (input.current !== null) input.current.ariaValueText = valueText(scale, target, guess);
  });

  /** Blocked, it keeps the focus and its place, and takes nothing. Without a pointer on it, it was Home or End. */
  function moved(element: HTMLInputElement): void {
    if (blocked) element.value = String(shown());
    else if (held.current) onDrag(element.valueAsNumber);
    else onLeap(element.valueAsNumber);
  }

  function release(): void {
    held.current = false;
    if (input.current !== null) input.current.value = String(shown());
  }

  function stepByKey(event: KeyboardEvent<HTMLInputElement>): void {
    const change = keyStep(event, scale);
    if (change === 0) return;
    event.preventDefault();
    if (!blocked) onMove(stepped(scale, shown(), change));
  }

  return (
    <div className={cx(styles.slider, blocked && styles.blocked, !isKnown && styles.unknown)}>
      <Track servo={servo} range={family.position} />
      {isNarrow(servo, family.position) && <Limits servo={servo} range={family.position} scale={scale} />}
      <EstimateMark servo={servo.servo} range={family.position} />
      {guess !== null && <GuessMark share={fraction(guess, family.position)} />}
      <input
        ref={input}
        type="range"
        className={styles.input}
        style={between(servo, family.position)}
        aria-label={words.servos.position(servo.servo)}
        aria-disabled={blocked}
        min={min}
        max={max}
        step={1}
        defaultValue={home}
        onInput={(event) => moved(event.currentTarget)}
        onKeyDown={stepByKey}
        onDoubleClick={() => blocked || onHome()}
        onPointerDown={() => (held.current = true)}
        onPointerUp={release}
        onPointerCancel={release}
      />
    </div>
  );
}

function valueText(scale: Scale, target: number | null, guess: number | null): string {
  if (target !== null) return scale.text(target);
  return guess === null ? words.servos.unknownValue : words.firstMoves.guessedValue(scale.text(guess));
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

function EstimateMark({ servo, range }: { readonly servo: number; readonly range: Range }) {
  const mark = useRef<SVGRectElement>(null);
  useMotion(servo, ({ estimated }) => {
    if (mark.current === null) return;
    setAttribute(mark.current, 'visibility', estimated === null ? 'hidden' : 'visible');
    if (estimated !== null) setAttribute(mark.current, 'x', thousandths(fraction(estimated, range)));
  });
  return (
    <div className={styles.whole} aria-hidden="true">
      <svg className={styles.estimate}>
        <rect ref={mark} visibility="hidden" width={3} height={9} rx={1} />
      </svg>
    </div>
  );
}

function GuessMark({ share }: { readonly share: number }) {
  return (
    <div className={styles.whole} aria-hidden="true">
      <div className={styles.guess} style={{ insetInlineStart: percent(share) }} />
    </div>
  );
}

/** A third of a pixel of the widest track: a shorter way is painted for nobody. */
const thousandths = (share: number): string => `${(share * 100).toFixed(1)}%`;

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
