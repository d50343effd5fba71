// A number one types: right-aligned, with its unit beside it. Arrow keys step by `step`, with Shift ten times as far, with
// Alt by one. Nothing is clamped silently: a value out of range goes to `onRefused` and the field shows the old one again.

import type { KeyboardEvent } from 'react';
import { Input, NumberField as AriaNumberField } from 'react-aria-components/NumberField';
import { cx } from './cx.ts';
import styles from './NumberField.module.css';

export interface NumberFieldProps {
  readonly label: string;
  /** null: not known; the field is empty and shows `placeholder`. */
  readonly value: number | null;
  readonly min: number;
  readonly max: number;
  readonly step?: number;
  readonly decimals?: 0 | 1;
  readonly unit?: string;
  readonly placeholder?: string;
  readonly size?: 'plain' | 'large' | 'small';
  readonly isDisabled?: boolean;
  /** Takes nothing for now, yet keeps its place and the focus. */
  readonly isReadOnly?: boolean;
  readonly excludeFromTabOrder?: boolean;
  onChange(value: number): void;
  onRefused(value: number): void;
}

export function NumberField(props: NumberFieldProps) {
  const { label, value, unit, placeholder, size = 'plain', isDisabled = false, isReadOnly = false } = props;

  function take(wanted: number): void {
    if (Number.isNaN(wanted) || wanted === value) return;
    if (wanted < props.min || wanted > props.max) props.onRefused(wanted);
    else props.onChange(wanted);
  }

  function stepByKey(event: KeyboardEvent): void {
    const change = stepOf(event, props.step ?? 1);
    if (change === 0 || isDisabled || isReadOnly) return;
    event.preventDefault();
    event.stopPropagation();
    const from = value ?? props.min;
    take(Math.min(props.max, Math.max(props.min, from + change)));
  }

  return (
    <div
      className={cx(styles.field, styles[size])}
      data-disabled={isDisabled || isReadOnly}
      onKeyDownCapture={stepByKey}
    >
      <AriaNumberField
        aria-label={label}
        className={styles.value ?? ''}
        value={value ?? Number.NaN}
        onChange={take}
        isDisabled={isDisabled}
        isReadOnly={isReadOnly}
        isWheelDisabled
        commitBehavior="validate"
        formatOptions={DIGITS[props.decimals ?? 0] ?? {}}
      >
        <Input
          className={styles.input ?? ''}
          placeholder={placeholder ?? ''}
          {...(props.excludeFromTabOrder === true && { tabIndex: -1 })}
        />
      </AriaNumberField>
      {unit !== undefined && (
        <span className={styles.unit} aria-hidden="true">
          {unit}
        </span>
      )}
    </div>
  );
}

/** By decimals. */
const DIGITS = [0, 1].map((digits): Intl.NumberFormatOptions => ({
  useGrouping: false,
  minimumFractionDigits: digits,
  maximumFractionDigits: digits,
}));

/** How far the key steps, 0 for other keys. */
export function stepOf(event: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'altKey'>, step: number): number {
  const direction = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key] ?? 0;
  if (event.altKey) return Math.sign(direction);
  return direction * step * (event.shiftKey ? 10 : 1);
}
