// A button with a verb, and an icon-only one with a name. Neutral by nature: colour is kept for what is true.

import type { ComponentProps, ReactNode, Ref } from 'react';
import { Button as AriaButton, type ButtonProps as AriaButtonProps } from 'react-aria-components/Button';
import { cx } from './cx.ts';
import { hinted } from './hinting.ts';
import { Icon, type IconName } from './Icon.tsx';
import { pressOnce } from './pressOnce.ts';
import styles from './Button.module.css';

export interface ButtonProps extends Omit<AriaButtonProps, 'className' | 'children' | 'style'> {
  readonly tone?: 'plain' | 'primary' | 'quiet' | 'danger';
  readonly icon?: IconName;
  readonly wide?: boolean;
  /** What the verb alone does not say. */
  readonly hint?: string;
  readonly children: ReactNode;
  readonly ref?: Ref<HTMLButtonElement>;
}

export function Button({ tone = 'plain', icon, wide = false, hint, children, ...rest }: ButtonProps) {
  return (
    <AriaButton
      {...rest}
      {...(hint === undefined ? {} : hinted(hint))}
      className={cx(styles.button, styles[tone], wide && styles.wide)}
    >
      {icon !== undefined && <Icon name={icon} />}
      <span className={styles.label}>{children}</span>
    </AriaButton>
  );
}

export interface IconButtonProps extends Pick<
  ComponentProps<'button'>,
  'aria-expanded' | 'aria-haspopup' | 'tabIndex'
> {
  readonly icon: IconName;
  readonly label: string;
  readonly isDisabled?: boolean | undefined;
  onPress(target: Element): void;
}

/** A bare button: there are dozens in a panel, and one of the library's takes as long to come up as five of them. */
export function IconButton({ icon, label, isDisabled, onPress, ...rest }: IconButtonProps) {
  return (
    <button
      {...rest}
      {...hinted(label)}
      type="button"
      disabled={isDisabled}
      aria-label={label}
      className={cx(styles.button, styles.quiet, styles.square)}
      onClick={({ currentTarget }) => onPress(currentTarget)}
      onKeyDown={pressOnce}
    >
      <Icon name={icon} />
    </button>
  );
}
