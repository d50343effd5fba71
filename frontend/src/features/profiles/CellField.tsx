// One figure of a table as a text one types. Taken on Enter or on leaving; what is not taken stays in the field, so that it
// can be mended, and the field is marked. Enter goes on in the same column of the next row.

import { useState, type KeyboardEvent } from 'react';
import { actionOf } from '../../ui/action.ts';
import { UNDO_ACTIONS } from '../undo/undoActions.ts';
import styles from './ServoTable.module.css';

export interface CellFieldProps {
  readonly label: string;
  readonly value: string;
  readonly isNumber?: boolean;
  readonly column?: string;
  /** Of the sentence that says what is wrong. */
  readonly problemId?: string | undefined;
  readonly maxLength?: number;
  /** false: it cannot be taken. */
  onTake(text: string): boolean;
}

export function CellField(props: CellFieldProps) {
  const { label, value, isNumber = false, column, problemId, maxLength = 64 } = props;
  const [draft, setDraft] = useState<string | null>(null);

  function leave(): void {
    if (draft === null) return;
    if (props.onTake(draft)) setDraft(null);
  }

  function key(event: KeyboardEvent<HTMLInputElement>): void {
    if (event.key === 'Enter') {
      // Leaving the field takes it; at the end of the column there is nowhere to go.
      const neighbour = neighbourOf(event.currentTarget, event.shiftKey ? -1 : 1);
      if (neighbour === undefined) leave();
      else neighbour.focus();
    }
    // What is being typed has the browser's own undo.
    if (draft !== null && actionOf(UNDO_ACTIONS, event) !== undefined) event.stopPropagation();
  }

  return (
    <input
      className={styles.input}
      aria-label={label}
      aria-invalid={problemId !== undefined}
      aria-describedby={problemId}
      data-column={column}
      data-number={isNumber}
      inputMode={isNumber ? 'decimal' : 'text'}
      maxLength={maxLength}
      autoComplete="off"
      spellCheck={false}
      value={draft ?? value}
      onChange={(event) => setDraft(event.target.value)}
      onFocus={(event) => event.target.select()}
      onBlur={leave}
      onKeyDown={key}
    />
  );
}

function neighbourOf(input: HTMLInputElement, step: 1 | -1): HTMLInputElement | undefined {
  const { column } = input.dataset;
  const list = input.closest('ol');
  if (column === undefined || list === null) return undefined;
  const cells = [...list.querySelectorAll<HTMLInputElement>(`[data-column='${column}']`)];
  return cells[cells.indexOf(input) + step];
}
