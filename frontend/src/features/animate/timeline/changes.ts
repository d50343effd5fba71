// The verbs that change the group: keys set, deleted, copied, turned round, eased. Each is one step of the history.

import type { Colour } from '#shared/document/schema.ts';
import { duplicateKeys, copyKeys, pasteKeys, type Clip, type Pasted } from '#shared/group/clip.ts';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { blockOver, blocksOf, motionTracks } from '#shared/group/blocks.ts';
import type { Easing } from '#shared/group/curves.ts';
import { holdsMotion } from '#shared/group/group.ts';
import { mirror, setColour, deleteMarker } from '#shared/group/frameEdits.ts';
import { deleteKeys, setEasing, setKey, smoothKeys } from '#shared/group/keyEdits.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { reverseKeys } from '#shared/group/keyRanges.ts';
import { deleteTime } from '#shared/group/timeEdits.ts';
import type { Label } from '#shared/document/history.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { keysAt, positionAt, type Key, type KeyRef } from '#shared/group/tracks.ts';
import { keySet, NO_KEYS, selectedKeys } from './timeline.ts';
import { isHeld } from '../../servoView.ts';
import { namesIn, servoName } from '../../../i18n/sentences.ts';
import { notPasted } from './clipText.ts';
import type { EasingName } from './valueText.ts';
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
  type TimelineContext,
} from './context.ts';
import { allKeys, type GroupTimes, spanOf } from '#shared/group/groupTimes.ts';

/** The servos of the cursor's row get a key where the playhead is, so that their motion stays as it is there. */
export function setKeys(context: TimelineContext): void {
  setKeysAt(context, rowOf(context, context.state.cursor.row)?.servos ?? [], context.state.playheadMs);
}

/** Of several servos those of which nothing is known stay without, unless it is so of all: these get one at home. */
export function setKeysAt(context: TimelineContext, servos: readonly number[], atMs: number): void {
  const free = servos.filter((servo) => !isHeld(context.servoView, servo));
  if (free.length === 0)
    return context.stores.notices.show('warning', words.timeline.status[whyHeld(context, servos)]);
  const covered = free.flatMap((servo) => blockOver(context.group, servo, atMs) ?? [])[0];
  if (covered !== undefined)
    return context.stores.notices.show('warning', words.blocks.covers({ name: covered.name }));
  const known = placedAt(free, (servo) => positionNow(context, servo, atMs));
  const placed = known.length > 0 ? known : placedAt(free, (servo) => homeOf(context, servo));
  if (placed.length === 0)
    return context.stores.notices.show(
      'info',
      words.actions.otherUnit({ unit: words.units[context.group.unit] }),
    );
  const { unit } = context.family;
  apply(context, {
    label: () => words.timeline.steps.setKey,
    edit: (group) =>
      placed.reduce(
        (sum, { servo, position: there }) => setKey(sum, servo, atMs, there),
        holdsMotion(group) ? group : { ...group, unit },
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

/** On its way at that time; else the commanded position; null where neither is known. */
function positionNow(context: TimelineContext, servo: number, atMs: number): number | null {
  const track = motionTracks(context.group, context.times.tracks).get(servo);
  const onItsWay = track === undefined ? null : positionAt(track, atMs);
  return onItsWay ?? (countsAlike(context) ? context.stores.device.motion(servo).target : null);
}

/** null where the current robot counts otherwise, or knows no such servo. */
const homeOf = (context: TimelineContext, servo: number): number | null =>
  countsAlike(context) ? (servoOf(context.robot, servo)?.home ?? null) : null;

const countsAlike = ({ isOther }: TimelineContext): boolean => !isOther;

export function remove(context: TimelineContext): void {
  const { marker } = context.state;
  if (marker !== null) {
    apply(context, {
      label: () => words.timeline.steps.deleteMarker,
      edit: (group) => deleteMarker(group, marker),
    });
  } else if (hasChangeable(context)) {
    const refs = changeable(context);
    apply(context, {
      label: () => words.timeline.steps.delete({ count: refs.length }),
      edit: (group) => deleteKeys(group, refs, { ripple: context.state.ripples }),
    });
  }
}

/** From the first to the last of the selected keys: the frames go with their time, which begins where the one before ends. */
export function removeTime(context: TimelineContext): void {
  const span = spanOf(selectedKeys(context.times, context.state.selected));
  if (span === null) return;
  const fromMs = context.times.ends.findLast((endMs) => endMs < span.fromMs) ?? 0;
  apply(context, {
    label: () => words.timeline.steps.deleteTime,
    edit: (group) => deleteTime(group, { fromMs, toMs: span.toMs }),
  });
}

/** null where nothing is selected. */
function clipOf({ group, times, state }: TimelineContext): Clip | null {
  const keys = selectedKeys(times, state.selected);
  return keys.length === 0 ? null : copyKeys(group, keys);
}

export function copy(context: TimelineContext): Clip | null {
  const clip = clipOf(context);
  if (clip !== null) {
    context.stores.timeline.setState({ clip });
    context.stores.notices.say(words.timeline.copied({ count: context.state.selected.size }));
  }
  return clip;
}

/** Keys on locked rows are copied and stay. */
export function cut(context: TimelineContext): Clip | null {
  const clip = copy(context);
  const refs = changeable(context);
  if (clip !== null)
    apply(context, {
      label: () => words.timeline.steps.cut({ count: refs.length }),
      edit: (group) => deleteKeys(group, refs, { ripple: context.state.ripples }),
    });
  return clip;
}

export function paste(context: TimelineContext, clip: Clip | null): void {
  if (clip === null) return context.stores.notices.show('info', words.timeline.nothingToPaste);
  const { playheadMs, ripples } = context.state;
  put(
    context,
    () => words.timeline.steps.paste,
    pasteKeys(context.group, clip, playheadMs, {
      ripple: ripples,
      rangeOf: (servo) => rangeOf(context, servo),
    }),
    ({ tracks }) => keysAt(tracks, clipKeys(clip, playheadMs)),
  );
}

const clipKeys = ({ moments }: Clip, atMs: number) =>
  moments.flatMap(({ atMs: afterMs, targets }) =>
    targets.map(({ servo }) => ({ servo, atMs: Math.round(atMs) + afterMs })),
  );

/** Right behind the selection, in the rhythm of its first frame. */
export function duplicate(context: TimelineContext): void {
  const keys = selectedKeys(context.times, context.state.selected);
  const span = spanOf(keys);
  if (span === null) return;
  const first = context.times.frames.find(({ id }) => keys.some(({ frameId }) => frameId === id));
  const deltaMs = span.toMs - span.fromMs + Math.max(context.family.motion.tickMs, first?.durationMs ?? 0);
  put(
    context,
    () => words.timeline.steps.duplicate,
    duplicateKeys(context.group, keys, deltaMs, { ripple: context.state.ripples }),
    ({ tracks }) =>
      keysAt(
        tracks,
        keys.map(({ servo, atMs }) => ({ servo, atMs: atMs + deltaMs })),
      ),
  );
}

/** All of it or nothing: what the robot must not do is not put into the group either. */
function put(
  context: TimelineContext,
  label: Label,
  { group, problems }: Pasted,
  selects: (times: GroupTimes) => readonly KeyRef[],
): void {
  const [problem] = problems;
  if (problem !== undefined)
    context.stores.notices.show('warning', notPasted(problem, namesIn(context.robot)));
  else apply(context, { label, edit: () => group, selects });
}

/** Each in its row; those of locked rows stay. */
export function turnRound(context: TimelineContext): void {
  if (!hasChangeable(context)) return;
  const refs = changeable(context);
  apply(context, {
    label: () => words.timeline.steps.reverse,
    edit: (group) => reverseKeys(group, refs),
    selects: (after) => reversedRefs(context, refs, after),
  });
}

/** What is selected where all its names are still there: a key that stays keeps its name, and none is lost. */
function reversedRefs(
  { state }: TimelineContext,
  keys: readonly Key[],
  after: GroupTimes,
): readonly KeyRef[] {
  const named = selectedKeys(after, state.selected);
  const span = spanOf(keys);
  const areSame = [keys.length, named.length].every((count) => count === state.selected.size);
  if (span === null || areSame) return named;
  return keysAt(
    after.tracks,
    keys.map(({ servo, atMs }) => ({ servo, atMs: span.fromMs + span.toMs - atMs })),
  );
}

export function mirrorFrames(context: TimelineContext): void {
  const frameIds = selectedFrames(context);
  const { group, held } = mirror(context.group, context.robot, frameIds);
  if (group === context.group) context.stores.notices.show('info', words.timeline.nothingToMirror);
  if (held.length > 0)
    context.stores.notices.show(
      'warning',
      heldAtLimit(held.map(({ servo }) => servoName(context.robot, servo))),
    );
  apply(context, { label: () => words.timeline.steps.mirror, edit: () => group });
}

export function ease(context: TimelineContext, name: EasingName, easing: Easing): void {
  const refs = changeable(context);
  if (!hasChangeable(context)) return;
  apply(context, {
    label: () => words.timeline.easings[name],
    edit: (group) => setEasing(group, refs, easing),
  });
}

/** The keys of these servos from the first to the last of the selected ones. */
export function block(context: TimelineContext): void {
  if (!hasChangeable(context)) return;
  const name = words.blocks.newName({ number: blocksOf(context.group).length + 1 });
  const made = makeBlock(context.group, changeable(context), name);
  if (made === null) return;
  apply(context, { label: () => words.blocks.steps.make, edit: () => made });
  context.stores.notices.say(words.blocks.made({ name }));
}

export function smooth(context: TimelineContext): void {
  if (!hasChangeable(context)) return;
  const refs = changeable(context);
  apply(context, {
    label: () => words.timeline.steps.smooth,
    edit: (group) => smoothKeys(group, refs),
  });
}

export function colour(context: TimelineContext, wanted: Colour | null): void {
  const frames = selectedFrames(context);
  apply(context, {
    label: () => words.timeline.steps.colour,
    edit: (group) => setColour(group, frames, wanted),
  });
}

export function selectAll(context: TimelineContext): void {
  const servos = context.rows.find(({ kind }) => kind === 'all')?.servos ?? [];
  select(context.stores, keySet(allKeys(context.times, servos)));
}

export function selectNone({ stores }: TimelineContext): void {
  select(stores, NO_KEYS);
}

function heldAtLimit(names: readonly string[]): string {
  return words.timeline.heldAtLimit({ count: names.length, names: words.numbers.formatNames(names) });
}
