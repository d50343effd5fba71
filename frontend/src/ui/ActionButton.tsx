// Buttons made from an action: its name, icon and key, and while it cannot be done, why.

import type { Action } from './action.ts';
import { IconButton } from './Button.tsx';

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
