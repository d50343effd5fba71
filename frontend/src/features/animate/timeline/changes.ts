// The verbs that change the group: keys set, deleted, copied, turned round, eased. Each is one step of the history.

import type { Colour } from '#shared/document/schema.ts';
import { duplicateKeys, copyKeys, pasteKeys, type Clip, type Pasted } from '#shared/group/clip.ts';
import { mirror, setColour, setEasing, deleteMarker } from '#shared/group/frameEdits.ts';
import type { Easing } from '#shared/group/group.ts';
import { deleteKeys, setKey } from '#shared/group/keyEdits.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { reverseKeys } from '#shared/group/keyRanges.ts';
import { deleteTime } from '#shared/group/timeEdits.ts';
import type { Label } from '#shared/document/history.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { keysAt, positionAt, type Key, type KeyRef } from '#shared/group/tracks.ts';
import { keySet, NO_KEYS } from './timeline.ts';
import { isHeld } from '../../drive/servoView.ts';
import { namesIn, servoName } from '../../profiles/servoName.ts';
import { notPasted } from './clipText.ts';
import { words } from '../../../i18n/whole.ts';
import {
  apply,
  changeable,
  hasChangeable,
  rangeOf,
  rowOf,
  select,
  selectedFrames,
  whyHeld,
  type Desk,
} from './desk.ts';
import { allKeys, selectedKeys, spanOf, type GroupTimes } from './groupTimes.ts';

/** The servos of the cursor's row get a key where the playhead is, so that their motion stays as it is there. */
export function setKeys(desk: Desk): void {
  setKeysAt(desk, rowOf(desk, desk.state.cursor.row)?.servos ?? [], desk.state.playheadMs);
}

/** Of several servos those of which nothing is known stay without, unless it is so of all: these get one at home. */
export function setKeysAt(desk: Desk, servos: readonly number[], atMs: number): void {
  const free = servos.filter((servo) => !isHeld(desk.servoView, servo));
  if (free.length === 0)
    return desk.stores.notices.tell('warning', words.timeline.status[whyHeld(desk, servos)]);
  const known = placedAt(free, (servo) => positionNow(desk, servo, atMs));
  const placed = known.length > 0 ? known : placedAt(free, (servo) => homeOf(desk, servo));
  if (placed.length === 0)
    return desk.stores.notices.tell('info', words.actions.otherUnit({ unit: words.units[desk.group.unit] }));
  const { unit } = desk.family;
  apply(desk, {
    label: () => words.timeline.steps.setKey,
    edit: (group) =>
      placed.reduce(
        (sum, { servo, position: there }) => setKey(sum, servo, atMs, there),
        group.frames.length === 0 ? { ...group, unit } : group,
      ),
    selects: ({ tracks }) =>
      keysAt(
        tracks,
        placed.map(({ servo }) => ({ servo, atMs: Math.round(atMs) })),
      ),
  });
}

const placedAt = (
  servos: readonly number[],
  positionOf: (servo: number) => number | null,
): readonly ServoTarget[] =>
  servos.flatMap((servo) => {
    const position = positionOf(servo);
    return position === null ? [] : [{ servo, position }];
  });

/** On its way at that time; else where the robot was asked to be; null where neither is known. */
function positionNow(desk: Desk, servo: number, atMs: number): number | null {
  const track = desk.times.tracks.get(servo);
  const onItsWay = track === undefined ? null : positionAt(track, atMs);
  return onItsWay ?? (countsAlike(desk) ? desk.stores.device.motion(servo).target : null);
}

/** null where the robot at hand counts otherwise, or knows no such servo. */
const homeOf = (desk: Desk, servo: number): number | null =>
  countsAlike(desk) ? (servoOf(desk.robot, servo)?.home ?? null) : null;

const countsAlike = ({ isOther }: Desk): boolean => !isOther;

export function remove(desk: Desk): void {
  const { marker } = desk.state;
  if (marker !== null) {
    apply(desk, {
      label: () => words.timeline.steps.deleteMarker,
      edit: (group) => deleteMarker(group, marker),
    });
  } else if (hasChangeable(desk)) {
    const refs = changeable(desk);
    apply(desk, {
      label: () => words.timeline.steps.delete({ count: refs.length }),
      edit: (group) => deleteKeys(group, refs, { ripple: desk.state.ripples }),
    });
  }
}

/** From the first to the last of the selected keys: the frames go with their time, which begins where the one before ends. */
export function removeTime(desk: Desk): void {
  const span = spanOf(selectedKeys(desk.times, desk.state.selected));
  if (span === null) return;
  const fromMs = desk.times.ends.findLast((endMs) => endMs < span.fromMs) ?? 0;
  apply(desk, {
    label: () => words.timeline.steps.deleteTime,
    edit: (group) => deleteTime(group, { fromMs, toMs: span.toMs }),
  });
}

/** null where nothing is selected. */
function clipOf({ group, times, state }: Desk): Clip | null {
  const keys = selectedKeys(times, state.selected);
  return keys.length === 0 ? null : copyKeys(group, keys);
}

export function copy(desk: Desk): Clip | null {
  const clip = clipOf(desk);
  if (clip !== null) {
    desk.stores.timeline.setState({ clip });
    desk.stores.notices.say(words.timeline.copied({ count: desk.state.selected.size }));
  }
  return clip;
}

/** Keys on locked rows are copied and stay. */
export function cut(desk: Desk): Clip | null {
  const clip = copy(desk);
  const refs = changeable(desk);
  if (clip !== null)
    apply(desk, {
      label: () => words.timeline.steps.cut({ count: refs.length }),
      edit: (group) => deleteKeys(group, refs, { ripple: desk.state.ripples }),
    });
  return clip;
}

export function paste(desk: Desk, clip: Clip | null): void {
  if (clip === null) return desk.stores.notices.tell('info', words.timeline.nothingToPaste);
  const { playheadMs, ripples } = desk.state;
  put(
    desk,
    () => words.timeline.steps.paste,
    pasteKeys(desk.group, clip, playheadMs, { ripple: ripples, rangeOf: (servo) => rangeOf(desk, servo) }),
    ({ tracks }) => keysAt(tracks, clipKeys(clip, playheadMs)),
  );
}

const clipKeys = ({ moments }: Clip, atMs: number) =>
  moments.flatMap(({ atMs: afterMs, targets }) =>
    targets.map(({ servo }) => ({ servo, atMs: Math.round(atMs) + afterMs })),
  );

/** Right behind the selection, in the rhythm of its first frame. */
export function duplicate(desk: Desk): void {
  const keys = selectedKeys(desk.times, desk.state.selected);
  const span = spanOf(keys);
  if (span === null) return;
  const first = desk.times.frames.find(({ id }) => keys.some(({ frameId }) => frameId === id));
  const deltaMs = span.toMs - span.fromMs + Math.max(desk.family.motion.tickMs, first?.durationMs ?? 0);
  put(
    desk,
    () => words.timeline.steps.duplicate,
    duplicateKeys(desk.group, keys, deltaMs, { ripple: desk.state.ripples }),
    ({ tracks }) =>
      keysAt(
        tracks,
        keys.map(({ servo, atMs }) => ({ servo, atMs: atMs + deltaMs })),
      ),
  );
}

/** All of it or nothing: what the robot must not do is not put into the group either. */
function put(
  desk: Desk,
  label: Label,
  { group, problems }: Pasted,
  selects: (times: GroupTimes) => readonly KeyRef[],
): void {
  const [problem] = problems;
  if (problem !== undefined) desk.stores.notices.tell('warning', notPasted(problem, namesIn(desk.robot)));
  else apply(desk, { label, edit: () => group, selects });
}

/** Each in its row; those of locked rows stay. */
export function turnRound(desk: Desk): void {
  if (!hasChangeable(desk)) return;
  const refs = changeable(desk);
  apply(desk, {
    label: () => words.timeline.steps.reverse,
    edit: (group) => reverseKeys(group, refs),
    selects: (after) => reversedRefs(desk, refs, after),
  });
}

/** What is selected where all its names are still there: a key that stays keeps its name, and none is lost. */
function reversedRefs({ state }: Desk, keys: readonly Key[], after: GroupTimes): readonly KeyRef[] {
  const named = selectedKeys(after, state.selected);
  const span = spanOf(keys);
  const areSame = [keys.length, named.length].every((count) => count === state.selected.size);
  if (span === null || areSame) return named;
  return keysAt(
    after.tracks,
    keys.map(({ servo, atMs }) => ({ servo, atMs: span.fromMs + span.toMs - atMs })),
  );
}

export function mirrorFrames(desk: Desk): void {
  const frameIds = selectedFrames(desk);
  const { group, held } = mirror(desk.group, desk.robot, frameIds);
  if (group === desk.group) desk.stores.notices.tell('info', words.timeline.nothingToMirror);
  if (held.length > 0)
    desk.stores.notices.tell('warning', heldAtLimit(held.map(({ servo }) => servoName(desk.robot, servo))));
  apply(desk, { label: () => words.timeline.steps.mirror, edit: () => group });
}

export function ease(desk: Desk, easing: Easing): void {
  const frames = selectedFrames(desk);
  apply(desk, {
    label: () => words.timeline.easings[easing],
    edit: (group) => setEasing(group, frames, easing),
  });
}

export function colour(desk: Desk, wanted: Colour | null): void {
  const frames = selectedFrames(desk);
  apply(desk, {
    label: () => words.timeline.steps.colour,
    edit: (group) => setColour(group, frames, wanted),
  });
}

export function selectAll(desk: Desk): void {
  const servos = desk.rows.find(({ kind }) => kind === 'all')?.servos ?? [];
  select(desk.stores, keySet(allKeys(desk.times, servos)));
}

export function selectNone({ stores }: Desk): void {
  select(stores, NO_KEYS);
}

function heldAtLimit(names: readonly string[]): string {
  return words.timeline.heldAtLimit({ count: names.length, names: words.numbers.formatNames(names) });
}
