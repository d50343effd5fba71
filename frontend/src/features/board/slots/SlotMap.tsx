// All slots of the board as a grid with one tab stop: what each holds as a mark, what plays it as a word. The chosen one is the
// slot that Download and Run mean.

import type { SlotFate } from '#shared/group/slotBook.ts';
import { useEffect, useRef, type KeyboardEvent } from 'react';
import { slotTrigger, type SlotTrigger } from '#shared/codec/families.ts';
import { useDevice, useStores, useSlot } from '../../stores.ts';
import { Mark } from '../../../ui/Chip.tsx';
import { cx } from '../../../ui/cx.ts';
import { words } from '../../../i18n/whole.ts';
import { slotAfterKey } from './slotKeys.ts';
import { FATE_TRUTH, useFates } from './useFates.ts';
import { useHeldName } from './useHeldName.ts';
import styles from './Slots.module.css';

export function SlotMap() {
  const { view } = useStores();
  const { slot: range, id } = useDevice((state) => state.family);
  const chosen = useSlot();
  const heldIn = useHeldName();
  const fateOf = useFates();
  const grid = useRef<HTMLDivElement>(null);
  const wantsFocus = useRef(false);
  const slots = Array.from({ length: range.max - range.min + 1 }, (_, index) => range.min + index);

  useEffect(() => {
    if (wantsFocus.current) grid.current?.querySelector<HTMLElement>('[tabindex="0"]')?.focus();
    wantsFocus.current = false;
  }, [chosen]);

  const key = (event: KeyboardEvent): void => {
    const next = slotAfterKey(event.key, chosen, { ...range, columns: columnsOf(grid.current) });
    if (next === null) return;
    event.preventDefault();
    wantsFocus.current = true;
    view.setState({ slot: next });
  };

  return (
    <div ref={grid} className={styles.map} role="listbox" aria-label={words.slots.map} onKeyDown={key}>
      {slots.map((slot) => {
        const fate = fateOf(slot);
        const trigger = slotTrigger(id, slot);
        const name = heldIn(slot);
        return (
          <button
            key={slot}
            type="button"
            role="option"
            className={cx(styles.cell, fate !== 'unknown' && fate !== 'empty' && styles.full)}
            aria-selected={slot === chosen}
            tabIndex={slot === chosen ? 0 : -1}
            aria-label={cellText(slot, fate, name)}
            onClick={() => view.setState({ slot })}
          >
            <span className={styles.number}>{words.numbers.formatWhole(slot)}</span>
            {fate !== 'unknown' && <Mark truth={FATE_TRUTH[fate]} />}
            <span className={styles.held}>{name ?? (trigger && triggerShort(trigger))}</span>
          </button>
        );
      })}
    </div>
  );
}

/** A narrow window has fewer. */
const columnsOf = (grid: HTMLElement | null): number =>
  grid === null ? 1 : getComputedStyle(grid).gridTemplateColumns.split(' ').length;

function cellText(slot: number, fate: SlotFate, name: string | undefined): string {
  const about = words.slots.about[fate];
  return name === undefined
    ? words.slots.cell({ slot, about })
    : words.slots.cellNamed({ slot, name, about });
}

function triggerShort(trigger: SlotTrigger): string {
  return trigger.kind === 'pad'
    ? words.slots.padSigns[trigger.button]
    : words.slots.triggersShort[trigger.kind];
}
