// The actions of the timeline and the other keys that mean something in it, each with what must be selected for it. Toolbar, menu,
// keys and the list of all actions are made from these. Escape is not among them: it is STOP everywhere.

import { chordOf, runByKey, type Action, type KeyUse, type Pressed } from '../../../ui/action.ts';
import { words, type Words } from '../../../i18n/whole.ts';
import { COLOURS, type Colour } from '#shared/document/schema.ts';
import {
  block,
  colour,
  copy,
  cut,
  duplicate,
  ease,
  mirrorFrames,
  paste,
  remove,
  removeTime,
  selectAll,
  selectNone,
  setKeys,
  smooth,
  turnRound,
} from './changes.ts';
import { soundOf } from '../sound/sound.ts';
import { toggleSpeed } from '../speed/SpeedRows.tsx';
import { editServoView } from '../../stores.ts';
import { toggled } from '../../servoView.ts';
import { motionTracks } from '#shared/group/blocks.ts';
import { fittedRange, rangeOf, rowOf, type TimelineContext } from './context.ts';
import type { Row } from './rows.ts';
import {
  fitAll,
  fitSelection,
  goToKey,
  page,
  selectRow,
  stepTicks,
  stepTo,
  toggleAtCursor,
  toggleRange,
  walk,
  zoom,
  type Direction,
} from './looking.ts';
import { goToMarker, nudge, nudgeMarker } from './moving.ts';
import { mayBeNegative } from './questions.ts';
import { EASING_CHOICES, type EasingName } from './valueText.ts';
import type { Ask, TimelineState } from './timeline.ts';

export type TimelineActionName = keyof Words['timeline']['verbs'];

interface Shown {
  readonly state: Pick<TimelineState, 'selected' | 'marker' | 'clip'>;
}

export type TimelineAction = Action<TimelineContext, Shown> & { readonly id: TimelineActionName };

interface Own extends Pick<TimelineAction, 'icon' | 'keys' | 'run'> {
  /** What must be selected, or copied, for it; left out: nothing. */
  readonly needs?: 'keys' | 'keysOrMarker' | 'clip';
}

const asking =
  (question: Ask): TimelineAction['run'] =>
  ({ stores }) =>
    stores.timeline.setState({ question });

/** Steps of the keys that go ten at a time. */
const FAR = 10;

const ACTIONS: Readonly<Record<TimelineActionName, Own>> = {
  setKey: { icon: 'plus', keys: ['Enter'], run: setKeys },
  editValue: { icon: 'edit', keys: ['F2'], needs: 'keys', run: asking('value') },
  remove: { icon: 'trash', keys: ['Delete', 'Backspace'], needs: 'keysOrMarker', run: remove },
  removeTime: { icon: 'erase', keys: ['Shift+Delete'], needs: 'keys', run: removeTime },
  cut: { icon: 'cut', keys: ['Ctrl+x'], needs: 'keys', run: (context) => void cut(context) },
  copy: { icon: 'copy', keys: ['Ctrl+c'], needs: 'keys', run: (context) => void copy(context) },
  paste: {
    icon: 'paste',
    keys: ['Ctrl+v'],
    needs: 'clip',
    run: (context) => paste(context, context.state.clip),
  },
  duplicate: { icon: 'duplicate', keys: ['Ctrl+d'], needs: 'keys', run: duplicate },
  insertTime: { icon: 'later', keys: ['i'], run: asking('insertTime') },
  reverse: { icon: 'reverse', keys: ['r'], needs: 'keys', run: turnRound },
  mirror: { icon: 'mirror', keys: ['x'], needs: 'keys', run: mirrorFrames },
  scaleTime: { icon: 'tune', keys: ['s'], needs: 'keys', run: asking('scaleTime') },
  scaleTimeBack: { icon: 'tune', keys: ['Shift+s'], needs: 'keys', run: asking('scaleTimeBack') },
  scaleAmplitude: { icon: 'tune', keys: ['a'], needs: 'keys', run: asking('scaleAmplitude') },
  block: { icon: 'frames', keys: ['b'], needs: 'keys', run: block },
  curve: { icon: 'live', keys: ['e'], needs: 'keys', run: asking('curve') },
  smooth: { icon: 'live', keys: ['Shift+e'], needs: 'keys', run: smooth },
  note: { icon: 'edit', keys: ['n'], needs: 'keys', run: asking('note') },
  marker: { icon: 'marker', keys: ['m'], run: asking('marker') },
  sound: { icon: 'upload', keys: [], run: ({ stores }) => void soundOf(stores).choose() },
  speed: { icon: 'tune', keys: ['v'], run: ({ stores }) => toggleSpeed(stores) },
  nextMarker: { icon: 'marker', keys: ['Shift+m'], run: goToMarker },
  selectAll: { icon: 'frames', keys: ['Ctrl+a'], run: selectAll },
  selectRow: {
    icon: 'frames',
    keys: ['Shift+a'],
    run: (context) => selectRow(context, context.state.cursor.row, 'toggles'),
  },
  selectNone: { icon: 'close', keys: ['Ctrl+Shift+a'], run: selectNone },
  toggleKey: { icon: 'frames', keys: ['Ctrl+ '], run: toggleAtCursor },
  // With Shift it is a key of its own, which no number begins with.
  zoomIn: { icon: 'plus', keys: ['+', '='], run: (context) => zoom(context, 1) },
  zoomOut: { icon: 'minus', keys: ['-', '_'], run: (context) => zoom(context, -1) },
  fitAll: { icon: 'fit', keys: ['f'], run: fitAll },
  fitSelection: { icon: 'fit', keys: ['Shift+f'], needs: 'keys', run: fitSelection },
  fitRows: {
    icon: 'fit',
    keys: [],
    run: ({ stores }) => stores.timeline.setState(({ fitsRows }) => ({ fitsRows: !fitsRows })),
  },
  range: { icon: 'refresh', keys: ['l'], run: toggleRange },
  keyBefore: { icon: 'earlier', keys: ['j'], run: (context) => goToKey(context, -1) },
  keyAfter: { icon: 'later', keys: ['k'], run: (context) => goToKey(context, 1) },
  toStart: { icon: 'earlier', keys: ['Home'], run: (context) => stepTo(context, 0) },
  toEnd: { icon: 'later', keys: ['End'], run: (context) => stepTo(context, context.times.lengthMs) },
  tickBefore: { icon: 'earlier', keys: ['<'], run: (context) => stepTicks(context, -1) },
  tickAfter: { icon: 'later', keys: ['>'], run: (context) => stepTicks(context, 1) },
  ticksBefore: { icon: 'earlier', keys: ['Shift+PageUp'], run: (context) => stepTicks(context, -FAR) },
  ticksAfter: { icon: 'later', keys: ['Shift+PageDown'], run: (context) => stepTicks(context, FAR) },
  pageBefore: { icon: 'earlier', keys: ['PageUp'], run: (context) => page(context, -1) },
  pageAfter: { icon: 'later', keys: ['PageDown'], run: (context) => page(context, 1) },
};

function enabled(needs: Own['needs'], shown: Shown): true | string {
  const { selected, marker, clip } = shown.state;
  if (needs === 'keys') return selected.size > 0 || words.timeline.needs.keys;
  if (needs === 'keysOrMarker')
    return selected.size > 0 || marker !== null || words.timeline.needs.keysOrMarker;
  return needs !== 'clip' || clip !== null || words.timeline.nothingToPaste;
}

/** Some mean a marker where one is selected. */
function labelOf(id: TimelineActionName, { state }: Shown): string {
  const { verbs, ...others } = words.timeline;
  const markerVerbs: Readonly<Partial<Record<TimelineActionName, string>>> = others.markerVerbs;
  return (state.marker === null ? undefined : markerVerbs[id]) ?? verbs[id];
}

const entries = Object.entries(ACTIONS) as readonly (readonly [TimelineActionName, Own])[];

export const TIMELINE_ACTIONS = Object.fromEntries(
  entries.map(([id, { needs, ...own }]): readonly [TimelineActionName, TimelineAction] => [
    id,
    { ...own, id, label: (shown) => labelOf(id, shown), enabled: (shown) => enabled(needs, shown) },
  ]),
) as Readonly<Record<TimelineActionName, TimelineAction>>;

const all = Object.values(TIMELINE_ACTIONS);

/** What is set on the frames of the selected keys: one action for each choice, in a menu under a name of their own. */
export interface ChoiceAction<Choice> extends Action<TimelineContext, Shown> {
  readonly choice: Choice;
  /** In its menu, where the label would repeat the menu's name. */
  shortLabel(): string;
}

const needsKeys = (shown: Shown): true | string => enabled('keys', shown);

const easingWord = (name: EasingName): string => words.timeline.easings[name];

const toEasing = ({ name, easing }: (typeof EASING_CHOICES)[number]): ChoiceAction<EasingName> => ({
  ...{ id: `easing-${name}`, icon: 'tune', keys: [], enabled: needsKeys, choice: name },
  label: () => words.timeline.setEasing({ easing: easingWord(name) }),
  shortLabel: () => easingWord(name),
  run: (context) => ease(context, name, easing),
});

export const EASING_ACTIONS: readonly ChoiceAction<EasingName>[] = EASING_CHOICES.map(toEasing);

const colourWord = (one: Colour | null): string =>
  one === null ? words.timeline.noColour : words.timeline.colours[one];

const toColour = (choice: Colour | null): ChoiceAction<Colour | null> => ({
  ...{ id: `colour-${choice ?? 'none'}`, icon: 'tune', keys: [], enabled: needsKeys, choice },
  label: () => words.timeline.setColour({ colour: colourWord(choice) }),
  shortLabel: () => colourWord(choice),
  run: (context) => colour(context, choice),
});

export const COLOUR_ACTIONS: readonly ChoiceAction<Colour | null>[] = [...COLOURS, null].map(toColour);

/** The rows of a list of the servo view: its icon, and its words where it is to have the row, and where it has it. */
const ROW_LISTS = {
  locked: { icon: 'lock', takes: 'lock', frees: 'unlock' },
  muted: { icon: 'mute', takes: 'mute', frees: 'unmute' },
  solo: { icon: 'solo', takes: 'solo', frees: 'unsolo' },
  armed: { icon: 'record', takes: 'arm', frees: 'disarm' },
  hidden: { icon: 'hide', takes: 'hide', frees: 'hide' },
} as const;

type RowAction = Action<TimelineContext>;

const cursorRow = (context: TimelineContext): Row | undefined => rowOf(context, context.state.cursor.row);

const toList = (list: keyof typeof ROW_LISTS): RowAction => ({
  ...{ id: list, icon: ROW_LISTS[list].icon, keys: [] },
  label(context) {
    const servos = cursorRow(context)?.servos ?? [];
    const isIn = servos.length > 0 && servos.every((servo) => context.servoView[list].includes(servo));
    return words.timeline.rows[ROW_LISTS[list][isIn ? 'frees' : 'takes']];
  },
  enabled: () => true,
  run(context) {
    const servos = cursorRow(context)?.servos ?? [];
    editServoView(context.stores, (before) => ({ ...before, [list]: toggled(before[list], servos) }));
  },
});

const isFolded = (context: TimelineContext): boolean =>
  context.servoView.folded.includes(cursorRow(context)?.name ?? '');

const isLarge = (context: TimelineContext): boolean =>
  context.state.large !== null && context.state.large.servo === cursorRow(context)?.servos[0];

/** Fitted to its motion as it is now: it must not grow under a key that is dragged. */
function toggleLarge(context: TimelineContext): void {
  const { stores, times, group } = context;
  const row = cursorRow(context);
  const [servo] = row?.servos ?? [];
  if (row?.kind !== 'servo' || servo === undefined) return;
  if (isLarge(context)) return stores.timeline.setState({ large: null });
  const track = motionTracks(group, times.tracks).get(servo);
  const { min, max } = fittedRange(track, rangeOf(context, servo), { evenAtRest: true });
  stores.timeline.setState({ large: { servo, min, max } });
}

/** What is done to the row of the cursor. */
export const ROW_ACTIONS: Readonly<Record<keyof typeof ROW_LISTS | 'folded' | 'large', RowAction>> = {
  large: {
    ...{ id: 'large', icon: 'live', keys: ['g'] },
    label: (context) => words.timeline.rows[isLarge(context) ? 'small' : 'large'],
    enabled: (context) => cursorRow(context)?.kind === 'servo' || words.timeline.needs.servoRow,
    run: toggleLarge,
  },
  locked: toList('locked'),
  muted: toList('muted'),
  solo: toList('solo'),
  armed: toList('armed'),
  hidden: toList('hidden'),
  folded: {
    ...{ id: 'folded', icon: 'down', keys: [] },
    label: (context) => words.timeline.rows[isFolded(context) ? 'unfold' : 'foldAway'],
    enabled: (context) => cursorRow(context)?.kind === 'limb' || words.timeline.needs.limb,
    run(context) {
      const limb = cursorRow(context)?.name ?? '';
      editServoView(context.stores, (before) => ({ ...before, folded: toggled(before.folded, [limb]) }));
    },
  },
};

const ARROWS: Readonly<Record<string, { direction: Direction; ticks: number; valueSteps: number }>> = {
  ArrowLeft: { direction: 'left', ticks: -1, valueSteps: 0 },
  ArrowRight: { direction: 'right', ticks: 1, valueSteps: 0 },
  ArrowUp: { direction: 'up', ticks: 0, valueSteps: 1 },
  ArrowDown: { direction: 'down', ticks: 0, valueSteps: -1 },
};

type TimelineKeys = KeyUse<TimelineContext>;

function arrows(held: string, press: (context: TimelineContext, arrow: (typeof ARROWS)[string]) => void) {
  return {
    keys: Object.keys(ARROWS).map((key) => held + key),
    press(context: TimelineContext, chord: string): void {
      const arrow = ARROWS[chord.slice(held.length)];
      if (arrow !== undefined) press(context, arrow);
    },
  };
}

/** With nothing selected the arrows go about; with keys selected they move these, and a selected marker before them. */
const moving =
  (far: number): Parameters<typeof arrows>[1] =>
  (context, { direction, ticks, valueSteps }) => {
    if (context.state.marker !== null && ticks !== 0) nudgeMarker(context, ticks * far);
    else if (context.state.selected.size === 0) walk(context, direction, null);
    else nudge(context, ticks * far, valueSteps * far);
  };

/** Typing a number is giving it to the selected keys, and a factor multiplies them. */
function type({ state, stores }: TimelineContext, typed: string): void {
  if (state.selected.size > 0) stores.timeline.setState({ question: 'value', typed });
}

/** Keys whose effect depends on which of them it is. They stand in no menu. */
export const TIMELINE_KEYS: readonly TimelineKeys[] = [
  { id: 'move', label: () => words.timeline.keyUses.move, ...arrows('', moving(1)) },
  { id: 'moveFar', label: () => words.timeline.keyUses.moveFar, ...arrows('Shift+', moving(FAR)) },
  {
    ...{ id: 'select', label: () => words.timeline.keyUses.select },
    ...arrows('Ctrl+', (context, { direction }) => walk(context, direction, 'replaces')),
  },
  {
    ...{ id: 'add', label: () => words.timeline.keyUses.add },
    ...arrows('Ctrl+Shift+', (context, { direction }) => walk(context, direction, 'adds')),
  },
  {
    ...{ id: 'type', label: () => words.timeline.keyUses.type, press: type },
    keys: ['0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '*', '/'],
  },
];

export const MENU_KEYS: Pick<TimelineKeys, 'id' | 'keys' | 'label'> = {
  ...{ id: 'menu', keys: ['Shift+F10', 'ContextMenu'], label: () => words.actionList.menu },
};

/** Whether the key means something in the timeline. */
export function pressInTimeline(context: TimelineContext, pressed: Pressed): boolean {
  const chord = chordOf(pressed);
  const use = TIMELINE_KEYS.find(({ keys }) => keys.includes(chord));
  // It begins a number where the selected keys can be below zero.
  if (chord === '-' && mayBeNegative(context)) type(context, chord);
  else if (use !== undefined) use.press(context, chord);
  else return runByKey(all, pressed, context) || runByKey([ROW_ACTIONS.large], pressed, context);
  return true;
}
