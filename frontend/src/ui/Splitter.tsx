// The line between two parts of a workspace: dragged, moved by arrows, and put back by a double click. Knows neither part, only
// the size in pixels of the one that is resized.

import { useRef, type KeyboardEvent, type PointerEvent } from 'react';
import styles from './Splitter.module.css';

const STEP_PX = 16;
const FAR_PX = 96;

interface SplitterProps {
  readonly label: string;
  /** `columns`: the parts stand side by side. */
  readonly between: 'columns' | 'rows';
  /** Of the part that is resized; null: its usual size. */
  readonly size: number | null;
  readonly usual: number;
  readonly min: number;
  readonly max: number;
  /** Whether the resized part stands before the line, left of it or above it. */
  readonly isBefore?: boolean;
  onSize(size: number | null): void;
}

export function Splitter(props: SplitterProps) {
  const { label, between, size, usual, min, max, isBefore = false, onSize } = props;
  const held = useRef<{ readonly at: number; readonly size: number } | null>(null);
  const isColumns = between === 'columns';
  const now = size ?? usual;
  const set = (wanted: number): void => onSize(Math.round(Math.min(max, Math.max(min, wanted))));
  const at = ({ clientX, clientY }: PointerEvent): number => (isColumns ? clientX : clientY);
  const larger = isBefore ? 1 : -1;

  function take(event: PointerEvent<HTMLElement>): void {
    event.currentTarget.setPointerCapture(event.pointerId);
    held.current = { at: at(event), size: now };
  }

  function key(event: KeyboardEvent): void {
    const step = event.shiftKey ? FAR_PX : STEP_PX;
    const [less, more] = isColumns
      ? (['ArrowLeft', 'ArrowRight'] as const)
      : (['ArrowUp', 'ArrowDown'] as const);
    const sizes: Readonly<Record<string, number>> = {
      [less]: now - larger * step,
      [more]: now + larger * step,
      Home: min,
      End: max,
    };
    const wanted = sizes[event.key];
    if (wanted === undefined) return;
    event.preventDefault();
    set(wanted);
  }

  return (
    <div
      role="separator"
      tabIndex={0}
      className={styles.splitter}
      data-between={between}
      aria-label={label}
      aria-orientation={isColumns ? 'vertical' : 'horizontal'}
      aria-valuenow={now}
      aria-valuemin={min}
      aria-valuemax={max}
      onPointerDown={take}
      onPointerMove={(event) => {
        if (held.current !== null) set(held.current.size + larger * (at(event) - held.current.at));
      }}
      onLostPointerCapture={() => (held.current = null)}
      onDoubleClick={() => onSize(null)}
      onKeyDown={key}
    />
  );
}
