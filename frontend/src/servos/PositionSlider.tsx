// A native range input over a scale with two marks: the thumb is the target, the bar below it the estimate. The input is
// uncontrolled so that a finger on it is never pushed about by what the session says meanwhile.

import { useEffect, useRef, type KeyboardEvent, type RefObject } from 'react';
import { fraction } from '../body/pose.ts';
import { useMotion } from '../body/useMotion.ts';
import type { RobotServo } from '#shared/actions/robot.ts';
import type { Family } from '#shared/protocol/families.ts';
import { cx } from '../ui/cx.ts';
import { words } from '../words/en.ts';
import { positionStep } from './positionStep.ts';
import styles from './PositionSlider.module.css';

export interface PositionSliderProps {
  readonly servo: RobotServo;
  readonly family: Family;
  readonly target: number | null;
  readonly blocked: boolean;
  onMove(position: number): void;
}

export function PositionSlider({ servo, family, target, blocked, onMove }: PositionSliderProps) {
  const input = useRef<HTMLInputElement>(null);
  const held = useRef(false);
  const { min, max, home } = servo;
  const shown = target ?? home;

  useEffect(() => {
    if (input.current !== null && !held.current) input.current.value = String(shown);
  }, [shown]);

  /** Blocked, it keeps the focus and its place, and takes nothing. */
  function moved(element: HTMLInputElement): void {
    if (blocked) element.value = String(shown);
    else onMove(element.valueAsNumber);
  }

  function stepByKey(event: KeyboardEvent<HTMLInputElement>): void {
    const change = keyStep(event, positionStep(family));
    if (change === 0) return;
    event.preventDefault();
    if (!blocked) onMove(Math.min(max, Math.max(min, shown + change)));
  }

  return (
    <div className={cx(styles.slider, blocked && styles.blocked, target === null && styles.unknown)}>
      <div className={styles.track} aria-hidden="true" />
      <EstimateMark servo={servo} />
      <input
        ref={input}
        type="range"
        className={styles.input}
        aria-label={words.servos.position(servo.servo)}
        aria-valuetext={
          target === null ? words.servos.unknownValue : words.servos.valueText(target, family.unit)
        }
        aria-disabled={blocked}
        min={min}
        max={max}
        step={1}
        defaultValue={shown}
        onInput={(event) => moved(event.currentTarget)}
        onKeyDown={stepByKey}
        onPointerDown={() => (held.current = true)}
        onPointerUp={() => release(held, input.current, shown)}
        onPointerCancel={() => release(held, input.current, shown)}
      />
    </div>
  );
}

function release(held: RefObject<boolean>, input: HTMLInputElement | null, shown: number): void {
  held.current = false;
  if (input !== null) input.value = String(shown);
}

function EstimateMark({ servo }: { readonly servo: RobotServo }) {
  const mark = useRef<HTMLDivElement>(null);
  useMotion(servo.servo, ({ estimated }) => {
    if (mark.current === null) return;
    mark.current.hidden = estimated === null;
    if (estimated !== null)
      mark.current.style.translate = `${(fraction(estimated, servo) * 100).toFixed(2)}% 0`;
  });
  return (
    <div className={styles.lane} aria-hidden="true">
      <div ref={mark} className={styles.estimate} hidden />
    </div>
  );
}

/** Arrows step by `step`, with Shift ten times as far, with Alt by one; Page keys ten steps. */
function keyStep({ key, shiftKey, altKey }: KeyboardEvent, step: number): number {
  const direction =
    { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10 }[key] ?? 0;
  if (altKey) return Math.sign(direction);
  return direction * step * (shiftKey ? 10 : 1);
}
