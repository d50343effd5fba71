// What an action of the page is: what a key, a menu, a button and the list of all actions share. Features list theirs beside their
// state; nothing here knows one of them.

import type { IconName } from './Icon.tsx';

/** `Shown` is the part of `Context` that decides how the action looks: a button follows that much and no more. */
export interface Action<Context, Shown = Context> {
  /** Within its list. */
  readonly id: string;
  readonly icon: IconName;
  /** Chords as `chordOf` names them. The first is the one that menus and hints show. */
  readonly keys: readonly string[];
  label(shown: Shown): string;
  /** `true`, or in a sentence why it cannot be done now. */
  enabled(shown: Shown): true | string;
  run(context: Context): void;
}

/** Keys that do the same in several ways, as by direction. They stand on the keyboard alone. */
export interface KeyUse<Context> {
  readonly id: string;
  readonly keys: readonly string[];
  label(): string;
  press(context: Context, chord: string): void;
}

export type Pressed = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'shiftKey' | 'altKey'>;

/** `Ctrl+Shift+a`; Command on a Mac is Ctrl. Shift counts only where it does not make another sign. */
export function chordOf({ key, ctrlKey, metaKey, shiftKey, altKey }: Pressed): string {
  const name = key.length === 1 ? key.toLowerCase() : key;
  const isLetter = key.length > 1 || /[a-z ]/.test(name);
  const held = [ctrlKey || metaKey ? 'Ctrl' : '', altKey ? 'Alt' : '', shiftKey && isLetter ? 'Shift' : ''];
  return [...held.filter((one) => one !== ''), name].join('+');
}

/** For `aria-keyshortcuts`. */
export const shortcutsOf = (keys: readonly string[]): string =>
  keys.map((chord) => chord.replace('Ctrl', 'Control').replace(/ $/u, 'Space')).join(' ');

/** They come as events of their own, because only those may touch the clipboard of the system. */
const OF_CLIPBOARD: readonly string[] = ['Ctrl+c', 'Ctrl+x', 'Ctrl+v'];

export function actionOf<One extends Pick<Action<never>, 'keys'>>(
  actions: readonly One[],
  pressed: Pressed,
): One | undefined {
  const chord = chordOf(pressed);
  return OF_CLIPBOARD.includes(chord) ? undefined : actions.find(({ keys }) => keys.includes(chord));
}

/** Whether the key was one of these actions; one that cannot be done now has its key and does nothing. */
export function runByKey<Context extends Shown, Shown>(
  actions: readonly Action<Context, Shown>[],
  pressed: Pressed,
  context: Context,
): boolean {
  const action = actionOf(actions, pressed);
  if (action?.enabled(context) === true) action.run(context);
  return action !== undefined;
}
