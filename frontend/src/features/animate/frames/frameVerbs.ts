// What is done to one frame or several: moved, duplicated, deleted, cut, copied, pasted. Each is one step of
// the history, and the selection goes along. Knows no panel; moves no robot.

import { copyFrames, pasteFrames, type Clip } from '#shared/group/clip.ts';
import { deleteFrames, duplicateFrames, moveFrames } from '#shared/group/groupEdits.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { type TimelineStores, contextOf, rangeOf, rowOf } from '../timeline/context.ts';
import { showFrame, showFrames } from '../timeline/inStep.ts';
import { ALL_ROW } from '../timeline/timeline.ts';
import { wholeFrames } from '../timeline/wholeFrames.ts';
import { namesIn } from '../../profiles/servoName.ts';
import { notPasted } from '../timeline/clipText.ts';
import { words } from '../../../i18n/whole.ts';

export type FrameIds = readonly number[];
/** As the person counts the frames, from 1. */
type Numbers = readonly number[];

/** The frame that is meant alone, or all that are selected where it is one of them. */
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
  if (clip === null) return stores.notices.tell('info', words.actions.nothingToPaste);
  const context = contextOf(stores);
  const index = numbersOf(stores, chosenFrames(stores)).at(-1) ?? context.group.frames.length;
  const pasted = pasteFrames(context.group, clip, index, { rangeOf: (servo) => rangeOf(context, servo) });
  const [problem] = pasted.problems;
  if (problem !== undefined)
    return stores.notices.tell('warning', notPasted(problem, namesIn(context.robot)));
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
