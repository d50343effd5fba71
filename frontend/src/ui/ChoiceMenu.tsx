// A menu of a few choices below the element that opened it.

import type { RefObject } from 'react';
import { Menu, MenuItem } from 'react-aria-components/Menu';
import { Popover } from 'react-aria-components/Popover';
import { InLanguage } from './InLanguage.tsx';
import styles from './Menu.module.css';

export interface ChoiceMenuProps {
  readonly label: string;
  readonly choices: readonly { readonly id: string; readonly name: string }[];
  readonly isOpen: boolean;
  readonly under: RefObject<Element | null>;
  onChoose(id: string): void;
  onClose(): void;
}

export function ChoiceMenu({ label, choices, isOpen, under, onChoose, onClose }: ChoiceMenuProps) {
  return (
    <InLanguage>
      <Popover
        className={styles.popover ?? ''}
        placement="bottom start"
        triggerRef={under}
        isOpen={isOpen}
        onOpenChange={(open) => !open && onClose()}
      >
        <Menu className={styles.menu ?? ''} aria-label={label} autoFocus="first" onClose={onClose}>
          {choices.map(({ id, name }) => (
            <MenuItem key={id} className={styles.item ?? ''} onAction={() => onChoose(id)}>
              {name}
            </MenuItem>
          ))}
        </Menu>
      </Popover>
    </InLanguage>
  );
}
