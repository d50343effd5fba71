// What each key does while the timeline has the focus. Escape is not among them: it is STOP everywhere. Copy, cut and paste come
// as events of their own, because only those may touch the clipboard of the system.

import { mayBeNegative } from './questions.ts';
import type { TimelineContext } from './context.ts';
import { page, stepTicks, stepTo, toggleAtCursor, walk, type Direction } from './looking.ts';
import { nudgeMarker } from './markers.ts';
import { nudge } from './moving.ts';
import { VERBS, mayRun } from './verbs.ts';

export type KeyAction = (context: TimelineContext) => void;
type Pressed = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'shiftKey' | 'altKey'>;

/** `Ctrl+Shift+a`; Command on a Mac is Ctrl. Shift counts only where it does not make another sign. */
export function chordOf({ key, ctrlKey, metaKey, shiftKey, altKey }: Pressed): string {
  const name = key.length === 1 ? key.toLowerCase() : key;
  const isLetter = key.length > 1 || /[a-z ]/.test(name);
  const held = [ctrlKey || metaKey ? 'Ctrl' : '', altKey ? 'Alt' : '', shiftKey && isLetter ? 'Shift' : ''];
  return [...held.filter((one) => one !== ''), name].join('+');
}

/** As it stands on the keys. */
export const chordText = (chord: string): string =>
  chord.replace(/(^|\+)(\p{Ll})$/u, (_, before: string, letter: string) => before + letter.toUpperCase());

const FAR = 10;
const ARROWS: readonly { key: string; direction: Direction; ticks: number; valueSteps: number }[] = [
  { key: 'ArrowLeft', direction: 'left', ticks: -1, valueSteps: 0 },
  { key: 'ArrowRight', direction: 'right', ticks: 1, valueSteps: 0 },
  { key: 'ArrowUp', direction: 'up', ticks: 0, valueSteps: 1 },
  { key: 'ArrowDown', direction: 'down', ticks: 0, valueSteps: -1 },
];

/** With nothing selected the arrows go about; with keys selected they move these, and a selected marker before them. */
function arrow({ direction, ticks, valueSteps }: (typeof ARROWS)[number], far: number): KeyAction {
  return (context) => {
    if (context.state.marker !== null && ticks !== 0) nudgeMarker(context, ticks * far);
    else if (context.state.selected.size === 0) walk(context, direction, null);
    else nudge(context, ticks * far, valueSteps * far);
  };
}

const OF_CLIPBOARD: readonly string[] = ['Ctrl+c', 'Ctrl+x', 'Ctrl+v'];

/** Typing a number is giving it to the selected keys, and a factor multiplies them. */
const DIGITS = ['0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '*', '/'];

const typing =
  (typed: string): KeyAction =>
  ({ state, stores }) => {
    if (state.selected.size > 0) stores.timeline.setState({ question: 'value', typed });
  };

/** It begins a number where the selected keys can be below zero; elsewhere nothing but zooming can be meant. */
const minus: KeyAction = (context) =>
  mayBeNegative(context) ? typing('-')(context) : VERBS.zoomOut.run(context);

const ACTIONS: ReadonlyMap<string, KeyAction> = new Map<string, KeyAction>([
  ...ARROWS.flatMap((one): [string, KeyAction][] => [
    [one.key, arrow(one, 1)],
    [`Shift+${one.key}`, arrow(one, FAR)],
    [`Ctrl+${one.key}`, (context) => walk(context, one.direction, 'replaces')],
    [`Ctrl+Shift+${one.key}`, (context) => walk(context, one.direction, 'adds')],
  ]),
  ['Ctrl+ ', toggleAtCursor],
  ...DIGITS.map((digit): [string, KeyAction] => [digit, typing(digit)]),
  ['Home', (context) => stepTo(context, 0)],
  ['End', (context) => stepTo(context, context.times.lengthMs)],
  ['<', (context) => stepTicks(context, -1)],
  ['>', (context) => stepTicks(context, 1)],
  ['PageUp', (context) => page(context, -1)],
  ['PageDown', (context) => page(context, 1)],
  ['Shift+PageUp', (context) => stepTicks(context, -FAR)],
  ['Shift+PageDown', (context) => stepTicks(context, FAR)],
  ['Backspace', VERBS.remove.run],
  ['=', VERBS.zoomIn.run],
  // The same key with Shift, which no number begins with.
  ['_', VERBS.zoomOut.run],
  ...Object.values(VERBS)
    .filter(({ keys }) => !OF_CLIPBOARD.includes(keys))
    .map((verb): [string, KeyAction] => [verb.keys, (context) => mayRun(context, verb) && verb.run(context)]),
  ['-', minus],
]);

export const actionOf = (pressed: Pressed): KeyAction | undefined => ACTIONS.get(chordOf(pressed));
