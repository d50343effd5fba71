// A button with text, and an icon button with a name. Neutral by default: colours mean states. Native buttons, because a panel has dozens
// of them and one of the library's takes five times as long to mount.

import type { ComponentProps, MouseEvent, ReactNode, Ref } from 'react';
import { cx } from './cx.ts';
import { hinted } from './hinting.ts';
import { Icon, type IconName } from './Icon.tsx';
import { pressOnce } from './inputEvents.ts';
import styles from './Button.module.css';

export interface ButtonProps extends Pick<
  ComponentProps<'button'>,
  'aria-expanded' | 'aria-haspopup' | 'aria-label' | 'autoFocus' | 'type'
> {
  readonly tone?: 'plain' | 'primary' | 'quiet' | 'danger';
  readonly icon?: IconName;
  readonly wide?: boolean;
  /** More than the label says. */
  readonly hint?: string;
  readonly isDisabled?: boolean | undefined;
  /** Ignores presses for now, and keeps the focus. */
  readonly isPending?: boolean;
  readonly children: ReactNode;
  readonly ref?: Ref<HTMLButtonElement>;
  onPress?(press: MouseEvent<HTMLButtonElement>): void;
}

/** True for a press by a key. */
export const isByKey = ({ detail }: Pick<MouseEvent, 'detail'>): boolean => detail === 0;

export function Button({
  tone = 'plain',
  icon,
  wide = false,
  hint,
  isDisabled,
  isPending = false,
  children,
  onPress,
  ...rest
}: ButtonProps) {
  return (
    <button
      type="button"
      {...rest}
      {...(hint === undefined ? {} : hinted(hint))}
      disabled={isDisabled}
      aria-disabled={isPending || undefined}
      className={cx(styles.button, styles[tone], wide && styles.wide)}
      onClick={isPending ? undefined : onPress}
      onKeyDown={pressOnce}
    >
      {icon !== undefined && <Icon name={icon} />}
      <span className={styles.label}>{children}</span>
    </button>
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
