// A field for a number with its unit. Arrow keys step by `step`, with Shift ten times as far, with Alt by one. Values out of range are
// not clamped: `onRefused` is called, the field shows the old value, and the message stays until the next valid number.
// A native input: the library's number field costs a millisecond per change, and 32 of them change at once.

import { useRef, useState, type ComponentType, type KeyboardEvent, type RefObject } from 'react';
import { Mark, type Truth } from './Chip.tsx';
import { cx } from './cx.ts';
import styles from './NumberField.module.css';

/** A text on the page that changes by itself. */
export interface FollowedTextProps {
  readonly element: RefObject<HTMLElement | null>;
  readonly colour: 'ink' | 'ink-dim';
  text(): string;
  write(text: string): void;
}

/** A number that changes by itself. */
export interface LiveNumber {
  now(): number | null;
  /** Draws the number without React, over the field's text. */
  readonly Show: ComponentType<FollowedTextProps>;
}

export interface NumberFieldProps {
  readonly label: string;
  /** null if unknown: the field is empty and shows `placeholder`. */
  readonly value: number | null | LiveNumber;
  readonly min: number;
  readonly max: number;
  readonly step?: number;
  readonly decimals?: 0 | 1;
  readonly unit?: string;
  readonly placeholder?: string;
  /** The kind of number: a mark before it, and a tooltip. */
  readonly truth?: { readonly mark: Truth; readonly title: string } | undefined;
  /** The start of steps while the value is unknown. */
  readonly start?: number;
  readonly size?: 'plain' | 'large' | 'small';
  readonly isDisabled?: boolean;
  /** Ignores input for now, and keeps its place and the focus. */
  readonly isReadOnly?: boolean;
  readonly excludeFromTabOrder?: boolean;
  /** `isStep`: a step by a key. */
  onChange(value: number, isStep: boolean): void;
  /** Returns a function that removes the message. */
  onRefused(value: number): () => void;
}

export function NumberField(props: NumberFieldProps) {
  const { label, unit, placeholder, size = 'plain', isDisabled = false, isReadOnly = false } = props;
  const input = useRef<HTMLInputElement>(null);
  /** The typed text; null while the field shows the value. */
  const [draft, setDraft] = useState<string | null>(null);
  const refusal = useRef<(() => void) | null>(null);
  const live = typeof props.value === 'object' ? props.value : null;
  const value = (): number | null => (typeof props.value === 'object' ? (live?.now() ?? null) : props.value);
  const text = (): string => draft ?? value()?.toFixed(props.decimals ?? 0) ?? '';
  const write = (now: string): void => {
    if (input.current !== null && input.current.value !== now) input.current.value = now;
  };

  function take(wanted: number, isStep: boolean): void {
    setDraft(null);
    if (Number.isNaN(wanted)) return;
    refusal.current?.();
    refusal.current = null;
    if (wanted === value()) return;
    if (wanted < props.min || wanted > props.max) refusal.current = props.onRefused(wanted);
    else props.onChange(wanted, isStep);
    if (live !== null && isStep) write(text());
  }

  function commit(): void {
    if (draft !== null) take(numberIn(draft, props.decimals ?? 0), false);
  }

  function onKey(event: KeyboardEvent): void {
    if (event.key === 'Enter') commit();
    const change = stepOf(event, props.step ?? 1);
    if (change === 0 || isDisabled || isReadOnly) return;
    event.preventDefault();
    event.stopPropagation();
    const from = value() ?? props.start ?? props.min;
    take(Math.min(props.max, Math.max(props.min, from + change)), true);
  }

  return (
    <div
      className={cx(styles.field, styles[size])}
      data-disabled={isDisabled || isReadOnly}
      title={props.truth?.title}
    >
      {props.truth !== undefined && (
        <span className={styles.mark}>
          <Mark truth={props.truth.mark} />
        </span>
      )}
      <input
        ref={input}
        type="text"
        inputMode={props.decimals === 1 ? 'decimal' : 'numeric'}
        autoComplete="off"
        aria-label={label}
        className={styles.input}
        value={text()}
        placeholder={placeholder}
        disabled={isDisabled}
        readOnly={isReadOnly}
        {...(props.excludeFromTabOrder === true && { tabIndex: -1 })}
        onChange={({ target }) => PARTIAL.test(target.value.replaceAll(/\s/gu, '')) && setDraft(target.value)}
        onBlur={commit}
        onKeyDown={onKey}
      />
      {live !== null && (
        <span className={styles.over}>
          <live.Show
            element={input}
            colour={isDisabled || isReadOnly ? 'ink-dim' : 'ink'}
            {...{ text, write }}
          />
        </span>
      )}
      {unit !== undefined && (
        <span className={styles.unit} aria-hidden="true">
          {unit}
        </span>
      )}
    </div>
  );
}

/** Text that may become a number. */
const PARTIAL = /^[-−]?\d*[.,]?\d*$/u;
const THOUSANDS = /[.,](?=\d{3}$)/u;

/** NaN if it is none. A comma counts as a point; in a whole number either may separate the thousands. */
export function numberIn(text: string, decimals: 0 | 1): number {
  const written = text.replaceAll(/\s/gu, '').replace('−', '-');
  const plain = (decimals === 0 ? written.replace(THOUSANDS, '') : written).replace(',', '.');
  return plain === '' ? NaN : Number(Number(plain).toFixed(decimals));
}

/** The step of a key, 0 for other keys. */
export function stepOf(event: Pick<KeyboardEvent, 'key' | 'shiftKey' | 'altKey'>, step: number): number {
  const direction = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key] ?? 0;
  if (event.altKey) return Math.sign(direction);
  return direction * step * (event.shiftKey ? 10 : 1);
}
