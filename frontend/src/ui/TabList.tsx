// A row of tabs that chooses one of several panels. Tab goes to the chosen one; arrows, Home and End choose another.

import type { KeyboardEvent } from 'react';
import { cx } from './cx.ts';
import { Icon, type IconName } from './Icon.tsx';
import styles from './TabList.module.css';

interface TabListProps<Id extends string> {
  readonly label: string;
  readonly tabs: readonly { readonly id: Id; readonly icon: IconName; readonly name: string }[];
  readonly chosen: Id;
  /** Icons beside the names instead of above them: as high as a button. */
  readonly isLow?: boolean;
  onChoose(id: Id): void;
}

export function TabList<Id extends string>({
  label,
  tabs,
  chosen,
  isLow = false,
  onChoose,
}: TabListProps<Id>) {
  function choose(event: KeyboardEvent<HTMLButtonElement>, index: number): void {
    const next = tabs.at(placeAfter(event.key, index, tabs.length) ?? index);
    if (next === undefined || next === tabs[index]) return;
    event.preventDefault();
    onChoose(next.id);
    document.getElementById(tabOf(next.id))?.focus();
  }
  return (
    <div role="tablist" aria-label={label} className={cx(styles.list, isLow && styles.low)}>
      {tabs.map(({ id, icon, name }, index) => {
        const isChosen = id === chosen;
        return (
          <button
            key={id}
            type="button"
            role="tab"
            id={tabOf(id)}
            aria-selected={isChosen}
            aria-controls={isChosen ? panelOf(id) : undefined}
            tabIndex={isChosen ? 0 : -1}
            className={styles.tab}
            onClick={() => onChoose(id)}
            onKeyDown={(event) => choose(event, index)}
          >
            <Icon name={icon} />
            {name}
          </button>
        );
      })}
    </div>
  );
}

/** Attributes of a tab's panel. */
export const tabPanel = (id: string) => ({
  role: 'tabpanel',
  id: panelOf(id),
  'aria-labelledby': tabOf(id),
});

const tabOf = (id: string): string => `tab-${id}`;
const panelOf = (id: string): string => `panel-${id}`;

/** Wraps at the ends; null for other keys. */
function placeAfter(key: string, index: number, count: number): number | null {
  if (key === 'ArrowRight') return (index + 1) % count;
  if (key === 'ArrowLeft') return index - 1;
  if (key === 'Home') return 0;
  return key === 'End' ? count - 1 : null;
}
