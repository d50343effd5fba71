// How recorded motion gets into a group, and the recording of armed rows over the motion of the others, which the robot plays meanwhile.
// Knows no dialog.

import { unpackedWithin } from '#shared/group/blockEdits.ts';
import { copyFrames, pasteKeys } from '#shared/group/clip.ts';
import { holdsMotion, type ActionGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { deleteKeys } from '#shared/group/keyEdits.ts';
import { simplify, type Sample } from '#shared/group/simplify.ts';
import { insertTime } from '#shared/group/timeEdits.ts';
import { startsKnown } from '#shared/robot/state.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { recorded } from '../../servoView.ts';
import { servoViewOf, type Stores } from '../../stores.ts';
import type { Action } from '../../../ui/action.ts';
import { namesIn } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { maySend } from './playActions.ts';
import type { PlayedSpan } from './playback.ts';
import { playerOf } from './player.ts';

/** An error that is not seen in a motion by hand. */
export const USUAL_ERROR = { us: 10, steps: 4 } as const;

export const keyCountOf = ({ frames }: ActionGroup): number =>
  frames.reduce((sum, { targets }) => sum + targets.length, 0);

/** Behind a gentle way from where the group ends; an empty one takes the unit. */
export function appended(before: ActionGroup, { frames, unit }: ActionGroup): ActionGroup {
  if (holdsMotion(before) && before.unit !== unit) return before;
  return frames.reduce((sum, frame) => insertFrame(sum, sum.frames.length, frame, unit), before);
}

/** Behind a gentle way from the pose there; what is behind comes so much later. */
export function inserted(before: ActionGroup, take: ActionGroup, atMs: number): ActionGroup {
  const clip = clipOf(take);
  const room = insertTime(before, atMs, clip.leadMs);
  return pasteKeys(room, clip, atMs + clip.leadMs, { ripple: true }).group;
}

/** In place of what its servos do there; all else stays at its time. */
export function over(before: ActionGroup, take: ActionGroup, atMs: number): ActionGroup {
  const clip = clipOf(take);
  const servos = new Set(take.frames.flatMap(({ targets }) => targets.map(({ servo }) => servo)));
  const untilMs = atMs + (clip.moments.at(-1)?.atMs ?? 0);
  // Under a block it would not be seen.
  const free = unpackedWithin(before, servos, { fromMs: atMs, toMs: untilMs });
  const replaced = [...timesOf(free).tracks]
    .filter(([servo]) => servos.has(servo))
    .flatMap(([, { keys }]) => keys.filter((key) => key.atMs >= atMs && key.atMs <= untilMs));
  const cleared = deleteKeys(free, replaced, { ripple: false });
  return pasteKeys(cleared, clip, atMs, { ripple: false }).group;
}

const clipOf = (take: ActionGroup) =>
  copyFrames(
    take,
    take.frames.map(({ id }) => id),
  );

type RecordContext = Pick<
  Stores,
  'playback' | 'device' | 'document' | 'view' | 'robots' | 'tape' | 'notices'
>;

/** Begins with the first press, ends with the second, or with the motion. The group has it then, as one step. */
export const RECORD_OVER: Action<RecordContext> = {
  ...{ id: 'recordOver', icon: 'record', keys: [] },
  label: (context) => (isRecording(context) ? words.record.overMotion.end : words.record.overMotion.begin),
  enabled(context) {
    if (isRecording(context)) return true;
    const { armed } = servoViewOf(context);
    if (armed.length === 0) return words.record.overMotion.needsArmed;
    const isIdle = context.playback.store.getState().phase === null;
    const may = isIdle ? maySend(context) : words.play.needsPause;
    if (may !== true) return may;
    // A first move is slow, and slows what plays where a board has one time for all servos (S26).
    const motion = context.device.motions();
    const unknown = armed.filter((servo) => !startsKnown(motion(servo)));
    const names = unknown.map(namesIn(context.robots.current().robot));
    return (
      names.length === 0 || words.record.overMotion.needsKnown({ names: words.numbers.formatNames(names) })
    );
  },
  run(context) {
    if (isRecording(context)) playerOf(context.playback).pause();
    else recordOver(context);
  },
};

const isRecording = (context: RecordContext): boolean => servoViewOf(context).overdubbed.length > 0;

function recordOver(context: RecordContext): void {
  const { servos } = recorded(servoViewOf(context), []);
  playerOf(context.playback).play({
    servos,
    ended(span) {
      if (span === null) context.notices.show('warning', words.record.overMotion.dropped);
      else put(context, span, servos);
    },
  });
}

function put(
  { tape, device, document, notices }: RecordContext,
  span: PlayedSpan,
  servos: readonly number[],
) {
  const samples = tape.since(span.beganMs, servos).map((sample) => inGroup(sample, span));
  const [first] = samples;
  if (first === undefined) {
    notices.show('info', words.record.nothing);
    return;
  }
  const { unit } = device.store.getState().family;
  const take = simplify(samples, {
    ...{ name: '', unit, leadMs: GENTLE_MOVE_MS },
    maxErrorUnits: USUAL_ERROR[unit],
  });
  document.edit(
    () => words.record.steps.over,
    (before) => over(before, take, first.atMs),
  );
  notices.show('info', words.record.overMotion.done({ keys: keyCountOf(take) }));
}

/** At its time in the group. */
function inGroup(sample: Sample, { fromMs, toMs, beganMs, rate }: PlayedSpan): Sample {
  const atMs = fromMs + (sample.atMs - beganMs) * rate;
  return { ...sample, atMs: Math.round(Math.min(toMs, atMs)) };
}
