// What is done to one frame or several: moved, duplicated, deleted, cut, copied, pasted. Each is one step of
// the history, and the selection goes along. Knows no panel; moves no robot.

import { copyFrames, pasteFrames, type Clip } from '#shared/group/clip.ts';
import { deleteFrames, duplicateFrames, moveFrames, sameList } from '#shared/group/groupEdits.ts';
import type { ActionGroup, GroupFrame } from '#shared/group/group.ts';
import { contextOf, rangeOf, rowOf, type TimelineStores, useRows } from '../timeline/context.ts';
import { showFrame, showFrames } from '../timeline/inStep.ts';
import { ALL_ROW, framesByServo, type KeySet, selectedKeys } from '../timeline/timeline.ts';
import { namesIn } from '../../../i18n/sentences.ts';
import { notPasted } from '../timeline/clipText.ts';
import { words } from '../../../i18n/whole.ts';
import type { Key } from '#shared/group/tracks.ts';
import { useStores } from '../../stores.ts';
import { useInFrame } from '../../../ui/useInFrame.ts';
import { type GroupTimes, timesOf } from '#shared/group/groupTimes.ts';

export type FrameIds = readonly number[];
/** As the person counts the frames, from 1. */
type Numbers = readonly number[];

/** The given frame alone, or all that are selected where it is one of them. */
export const together = (whole: FrameIds, id: number): FrameIds => (whole.includes(id) ? whole : [id]);

export function togetherNow(stores: TimelineStores, id: number): FrameIds {
  const context = contextOf(stores);
  const shown = new Set(rowOf(context, ALL_ROW)?.servos);
  return together(wholeFrames(context.times, context.state.selected, shown), id);
}

/** None where no frame is selected. */
export function chosenFrames(stores: TimelineStores): FrameIds {
  const { selectedFrame } = stores.view.getState();
  const isThere = framesNow(stores).some(({ id }) => id === selectedFrame);
  return selectedFrame === null || !isThere ? [] : togetherNow(stores, selectedFrame);
}

const framesNow = ({ document }: TimelineStores): ActionGroup['frames'] =>
  document.store.getState().present.frames;

export function numbersOf(stores: TimelineStores, ids: FrameIds): Numbers {
  const wanted = new Set(ids);
  return framesNow(stores).flatMap(({ id }, index) => (wanted.has(id) ? [index + 1] : []));
}

interface Counted {
  readonly count: number;
  /** The first of them. */
  readonly frame: number;
}

/** As messages about frames take them. */
export function counted(numbers: Numbers): Counted {
  return { count: numbers.length, frame: numbers[0] ?? 0 };
}

/** Those that belong with the frame go so many places on, or with a negative number back; where they were apart they meet. */
export function moveBy(stores: TimelineStores, id: number, places: number): void {
  const ids = togetherNow(stores, id);
  const before = numbersOf(stores, ids);
  const from = (places < 0 ? before[0] : before.at(-1)) ?? 1;
  const lead = framesNow(stores)[from - 1]?.id ?? id;
  stores.document.edit(
    () => words.actions.steps.move(counted(before)),
    (group) => moveFrames(group, ids, lead, from - 1 + places),
  );
  showFrames(stores, ids, id);
  const after = numbersOf(stores, ids);
  if (after.join() === before.join()) return;
  const count = after.length;
  const [first = 0] = after;
  stores.notices.say(
    words.actions.moved({ count, from: before[0] ?? 0, first, last: after.at(-1) ?? first }),
  );
}

/** What comes next is selected then. */
export function removeFrames(stores: TimelineStores, ids: FrameIds): void {
  takeOut(stores, ids, words.actions.steps.delete);
}

function takeOut(stores: TimelineStores, ids: FrameIds, step: (values: Counted) => string): void {
  const numbers = numbersOf(stores, ids);
  const frames = framesNow(stores);
  const first = (numbers[0] ?? 1) - 1;
  const stays = ({ id }: { readonly id: number }): boolean => !ids.includes(id);
  const next = frames.slice(first).find(stays) ?? frames.slice(0, first).findLast(stays);
  stores.document.edit(
    () => step(counted(numbers)),
    (group) => deleteFrames(group, ids),
  );
  showFrame(stores, next?.id ?? null);
}

export function duplicate(stores: TimelineStores, ids: FrameIds): void {
  const numbers = numbersOf(stores, ids);
  add(
    stores,
    () => words.actions.steps.duplicate(counted(numbers)),
    (group) => duplicateFrames(group, ids),
  );
}

/** The new frames are selected then. */
function add(stores: TimelineStores, step: () => string, edit: (group: ActionGroup) => ActionGroup): void {
  const { nextId } = stores.document.store.getState().present;
  stores.document.edit(step, edit);
  const ids = framesNow(stores).flatMap(({ id }) => (id >= nextId ? [id] : []));
  const [first] = ids;
  if (first !== undefined) showFrames(stores, ids, first);
}

/** null where nothing is selected. */
export function copy(stores: TimelineStores, ids: FrameIds): Clip | null {
  if (ids.length === 0) return null;
  const clip = copyFrames(stores.document.store.getState().present, ids);
  stores.timeline.setState({ clip });
  stores.notices.say(words.actions.copied({ count: ids.length }));
  return clip;
}

export function cut(stores: TimelineStores, ids: FrameIds): Clip | null {
  const clip = copy(stores, ids);
  if (clip !== null) takeOut(stores, ids, words.actions.steps.cut);
  return clip;
}

/** Behind those that are selected, else at the end. All of it or nothing: what the robot must not do is not pasted. */
export function paste(stores: TimelineStores, clip: Clip | null): void {
  if (clip === null) return stores.notices.show('info', words.actions.nothingToPaste);
  const context = contextOf(stores);
  const index = numbersOf(stores, chosenFrames(stores)).at(-1) ?? context.group.frames.length;
  const pasted = pasteFrames(context.group, clip, index, { rangeOf: (servo) => rangeOf(context, servo) });
  const [problem] = pasted.problems;
  if (problem !== undefined)
    return stores.notices.show('warning', notPasted(problem, namesIn(context.robot)));
  add(
    stores,
    () => words.actions.steps.paste({ count: clip.moments.length }),
    () => pasted.group,
  );
}

export function selectAllFrames(stores: TimelineStores, lead: number): void {
  showFrames(
    stores,
    framesNow(stores).map(({ id }) => id),
    lead,
  );
}

// Which frames are selected as a whole, with every key of theirs in a row that is shown, and the rests between them: what the strip
// marks, and what is done to several frames is done to. The list is pure, and stays the same object while its content does.

/** In the order of time. A frame without a key to select goes with the frames on both sides of it. */
export function wholeFrames(
  { frames }: Pick<GroupTimes, 'frames'>,
  selected: KeySet,
  shownServos: ReadonlySet<number>,
): readonly number[] {
  const chosen = framesByServo(selected);
  const ids: number[] = [];
  let isBehindWhole = false;
  let rests: number[] = [];
  for (const frame of frames) {
    const state = stateOf(frame, chosen, shownServos);
    if (state === 'rest') {
      rests.push(frame.id);
      continue;
    }
    if (state === 'whole') ids.push(...(isBehindWhole ? rests : []), frame.id);
    isBehindWhole = state === 'whole';
    rests = [];
  }
  return ids;
}

/** By its keys in rows that are shown. */
function stateOf(
  { id, targets }: GroupFrame,
  chosen: ReturnType<typeof framesByServo>,
  shownServos: ReadonlySet<number>,
): 'whole' | 'partial' | 'rest' {
  let state: 'whole' | 'rest' = 'rest';
  for (const { servo } of targets) {
    if (!shownServos.has(servo)) continue;
    if (chosen.get(servo)?.has(id) !== true) return 'partial';
    state = 'whole';
  }
  return state;
}

interface Whole {
  readonly shown: readonly number[];
  readonly ids: readonly number[];
}

/** By the selected keys, of which there is one list for each selection in each state of the group. */
const known = new WeakMap<readonly Key[], Whole>();
let latest: readonly number[] = [];

/** The very same list as before where it says the same: an edit that leaves them the same has nothing drawn again. */
function wholeNow(times: GroupTimes, selected: KeySet, shown: readonly number[]): readonly number[] {
  const keys = selectedKeys(times, selected);
  const before = known.get(keys);
  if (before?.shown === shown) return before.ids;
  latest = sameList(before?.ids ?? latest, wholeFrames(times, selected, new Set(shown)));
  known.set(keys, { shown, ids: latest });
  return latest;
}

/** With the next frame: what an edit of thousands of keys does to strip and tools does not keep the key that made it. */
export function useWholeFrames(): readonly number[] {
  const { document, timeline } = useStores();
  const shown = useRows().find(({ kind }) => kind === 'all')?.servos ?? NO_SERVOS;
  return useInFrame(document.store, ({ present }) =>
    wholeNow(timesOf(present), timeline.getState().selected, shown),
  );
}

const NO_SERVOS: readonly number[] = [];
