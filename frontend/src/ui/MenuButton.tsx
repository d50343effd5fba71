// A button below which a few choices open.

import type { ReactNode } from 'react';
import { Menu, MenuItem, MenuTrigger } from 'react-aria-components/Menu';
import { Popover } from 'react-aria-components/Popover';
import { Button, type ButtonProps } from './Button.tsx';
import styles from './Menu.module.css';

interface MenuButtonProps extends Pick<ButtonProps, 'tone'> {
  readonly label: string;
  /** What the button shows in the label's place. */
  readonly children?: ReactNode;
  readonly choices: readonly { readonly id: string; readonly name: string }[];
  onChoose(id: string): void;
}

export function MenuButton({ label, children = label, choices, onChoose, ...button }: MenuButtonProps) {
  return (
    <MenuTrigger>
      <Button {...button}>{children}</Button>
      <Popover className={styles.popover ?? ''} placement="bottom start">
        <Menu className={styles.menu ?? ''} aria-label={label}>
          {choices.map(({ id, name }) => (
            <MenuItem key={id} className={styles.item ?? ''} onAction={() => onChoose(id)}>
              {name}
            </MenuItem>
          ))}
        </Menu>
      </Popover>
    </MenuTrigger>
  );
}
