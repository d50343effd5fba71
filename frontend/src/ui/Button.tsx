// A button with text, and an icon button with a name; both can be made from an action. Neutral by default: colours mean states. Native
// buttons, because a panel has dozens of them and one of the library's takes five times as long to mount.

import type { ComponentProps, MouseEvent, ReactNode, Ref } from 'react';
import { cx } from './cx.ts';
import { hinted, type Hinted } from './hinting.ts';
import { Icon, type IconName } from './Icon.tsx';
import { pressOnce } from './inputEvents.ts';
import styles from './Button.module.css';
import type { Action } from './action.ts';

export interface ButtonProps
  extends
    Hinted,
    Pick<ComponentProps<'button'>, 'aria-expanded' | 'aria-haspopup' | 'aria-label' | 'autoFocus' | 'type'> {
  readonly tone?: 'plain' | 'primary' | 'quiet' | 'danger';
  readonly icon?: IconName;
  readonly wide?: boolean;
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
  keys,
  whyNot,
  isDisabled = whyNot !== undefined,
  isPending = false,
  children,
  onPress,
  ...rest
}: ButtonProps) {
  return (
    <button
      type="button"
      {...rest}
      {...hinted({ hint, keys, whyNot })}
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

export interface IconButtonProps
  extends
    Pick<Hinted, 'keys' | 'whyNot'>,
    Pick<ComponentProps<'button'>, 'aria-expanded' | 'aria-haspopup' | 'aria-pressed' | 'tabIndex'> {
  readonly icon: IconName;
  readonly label: string;
  readonly isDisabled?: boolean | undefined;
  onPress(target: Element): void;
}

export function IconButton({ icon, label, keys, whyNot, onPress, ...props }: IconButtonProps) {
  const { isDisabled = whyNot !== undefined, ...rest } = props;
  return (
    <button
      {...rest}
      {...hinted({ hint: label, keys, whyNot })}
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

interface ActionButtonProps<Context, Shown> {
  readonly action: Action<Context, Shown>;
  readonly shown: Shown;
  /** What it works with when it is pressed. */
  context(): Context;
}

/** `whyNot` as buttons take it. */
const whyNotOf = (enabled: true | string): string | undefined => (enabled === true ? undefined : enabled);

export function ActionIconButton<Context, Shown>({
  action,
  shown,
  context,
}: ActionButtonProps<Context, Shown>) {
  const { icon, keys } = action;
  return (
    <IconButton
      {...{ icon, keys, label: action.label(shown), whyNot: whyNotOf(action.enabled(shown)) }}
      onPress={() => action.run(context())}
    />
  );
}

export function ActionButton<Context, Shown>({
  action,
  shown,
  context,
  ...looks
}: ActionButtonProps<Context, Shown> & Pick<ButtonProps, 'tone' | 'hint'>) {
  const { icon, keys } = action;
  return (
    <Button
      {...{ ...looks, icon, keys, whyNot: whyNotOf(action.enabled(shown)) }}
      onPress={() => action.run(context())}
    >
      {action.label(shown)}
    </Button>
  );
}
