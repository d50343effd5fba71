// Buttons made from an action: its name, icon and key, and while it cannot be done, why.

import type { Action } from './action.ts';
import { Button, IconButton, type ButtonProps } from './Button.tsx';

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
