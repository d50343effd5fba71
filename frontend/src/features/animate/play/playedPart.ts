// What playing means now: which part of the group, from where, how often, and which servos hear of it; and where in the group one is while it
// plays, from the page, on the board, or on the drawing alone: as a place at a time, and as the line over the clock that a sound follows.
// Plays nothing.

import { motionLengthMs, motionTracks } from '#shared/group/blocks.ts';
import { passageOf, type Passage, type PassageOptions } from '#shared/group/passage.ts';
import { poseAtMs } from '#shared/group/tracks.ts';
import type { Frame, ServoTarget } from '#shared/codec/commands.ts';
import type { Family } from '#shared/codec/families.ts';
import { moveBytes, wireMs } from '#shared/codec/packet.ts';
import { startsKnown } from '#shared/robot/state.ts';
import { FIRST_MOVE_MS, RANGE_MS } from '#shared/robot/timings.ts';
import type { CompiledGroup } from '../../board/compile/compiled.ts';
import type { Device } from '../../../robot/device.ts';
import type { Document } from '../../groupDocument.ts';
import type { FollowedPose } from '../../../robot/follower.ts';
import { chosenTimes } from '../../board/slots/groupPlace.ts';
import type { PlayedSpan, Playhead } from './playback.ts';
import type { RobotStore } from '../../profiles/robots.ts';
import { isSilent, servoViewFor } from '../../servoView.ts';
import type { View } from '../../view.ts';
import type { Course } from '../sound/soundPlayer.ts';

export interface PlayedPart {
  /** Where the playhead is within the part to play; null: it begins at the beginning, as a loop always does. */
  within(): number | null;
  /** What was marked, or all of it. */
  part(): { readonly fromMs: number; readonly toMs: number };
  /** As often as the group is run on its board; from within it, the rest once. 0: until stopped. */
  passes(): number;
  /** What goes to the robot of it; these servos are left out. */
  passage(group: CompiledGroup, without?: readonly number[]): Passage;
  /** Of the servos that hear of it. */
  poseAt(atMs: number): FollowedPose;
}

export interface PlayedPartOptions {
  readonly device: Device;
  readonly document: Document;
  readonly view: View;
  readonly playhead: Playhead;
  readonly robots: RobotStore;
  chosen(): { readonly loops: boolean; readonly speedPercent: number };
}

/** Of a servo's range: a step of so much is not seen as a jerk. */
const LARGEST_SEAM = 0.05;

const seamOf = ({ position: { min, max } }: Family): PassageOptions['seam'] => ({
  largestStep: (max - min) * LARGEST_SEAM,
  unitsPerMs: (max - min) / RANGE_MS,
});

/** A delay of so much is hardly felt at a slider. */
const PART_BESIDE_MS = 80;
const SHARE_OF_WIRE = 0.25;

/**
 * Beside the user's moves frames are sent in short parts: where a board has one time for all servos (S26), each of those moves lasts as long as the
 * part under way. A part is long enough to leave three quarters of the wire to them.
 */
function partBesideMs(frames: readonly Frame[]): number {
  const most = frames.reduce((count, { targets }) => Math.max(count, targets.length), 0);
  return Math.max(PART_BESIDE_MS, Math.ceil(wireMs(moveBytes(most)) / SHARE_OF_WIRE));
}

export function createPlayedPart(options: PlayedPartOptions): PlayedPart {
  const { device, document, view, playhead, robots, chosen } = options;

  function within(): number | null {
    const { fromMs, toMs } = part();
    const at = playhead.at();
    return at > fromMs && at < toMs && !chosen().loops ? at : null;
  }

  function part(): { readonly fromMs: number; readonly toMs: number } {
    return playhead.range() ?? { fromMs: 0, toMs: motionLengthMs(document.store.getState().present) };
  }

  function passes(): number {
    if (chosen().loops) return 0;
    return within() === null ? chosenTimes(view.getState()) : 1;
  }

  /** Rows that are muted, or beside those that play alone, are not sent. */
  function isSent({ servo }: Pick<ServoTarget, 'servo'>): boolean {
    return !isSilent(servoViewFor(view.getState().servos, robots.current().id), servo);
  }

  function passage({ frames, source }: CompiledGroup, without: readonly number[] = []): Passage {
    const range = playhead.range();
    const isPlayed = (target: ServoTarget): boolean => isSent(target) && !without.includes(target.servo);
    const played = frames.map((frame): Frame => ({ ...frame, targets: frame.targets.filter(isPlayed) }));
    return passageOf(played, {
      fromMs: within() ?? range?.fromMs ?? 0,
      toMs: range?.toMs ?? null,
      seam: seamOf(source.family),
      longestMs: source.family.durationMs.max,
      longestPartMs: without.length > 0 ? partBesideMs(played) : undefined,
      speedPercent: chosen().speedPercent,
      unknownServos: source.robot.servos
        .map(({ servo }) => servo)
        .filter((servo) => !startsKnown(device.motion(servo))),
    });
  }

  function poseAt(atMs: number): FollowedPose {
    const pose = poseAtMs(motionTracks(document.store.getState().present), atMs);
    return new Map(
      [...pose].flatMap(([servo, position]) => (isSent({ servo }) ? [[servo, Math.round(position)]] : [])),
    );
  }

  return { within, part, passes, passage, poseAt };
}

// Where one is, in ms of the group.

/** What plays from the page: which frame of its passage began when. */
export interface PagePlay {
  readonly passage: Passage;
  readonly index: number;
  readonly beganMs: number;
  /** Gently on the way to the first pose, which is where one then is. */
  readonly isLead: boolean;
  /** It is known to have begun: until then it was only requested. */
  readonly isUnderWay: boolean;
  readonly speedPercent: number;
  /** This one included; 0: until stopped. */
  readonly passesLeft: number;
}

export function pageAt({ passage, index, beganMs, isLead }: PagePlay, nowMs: number): number {
  const { frames, atMs, beginMs } = passage;
  const to = atMs[index] ?? 0;
  const durationMs = frames[index]?.durationMs ?? 0;
  const from = index === 0 ? (isLead ? to : beginMs) : (atMs[index - 1] ?? 0);
  const share = durationMs === 0 ? 1 : Math.min(1, (nowMs - beganMs) / durationMs);
  return from + (to - from) * share;
}

/** From the frame that begins now. */
export function spanOf({ passage: { atMs }, index, beganMs, speedPercent }: PagePlay): PlayedSpan {
  const fromMs = atMs[index - 1] ?? 0;
  return { fromMs, toMs: atMs.at(-1) ?? fromMs, beganMs, rate: speedPercent / 100 };
}

/** The way to the first pose ends where the passage begins. What the sound has before that is heard on the way, so that it is there in time. */
export function pageCourse(play: PagePlay): Course {
  const { passage, index, beganMs, isLead, speedPercent, passesLeft } = play;
  const { frames, atMs, beginMs, loopFrom } = passage;
  const rate = speedPercent / 100;
  const to = atMs[index] ?? 0;
  const durationMs = frames[index]?.durationMs ?? 0;
  const ways = { rate, untilMs: atMs.at(-1) ?? 0, thenMs: thenMs() };
  if (index > 0) return { ...ways, atMs: atMs[index - 1] ?? 0, sinceMs: beganMs };
  const endMs = beganMs + (isLead ? Math.max(durationMs, FIRST_MOVE_MS) : durationMs);
  return { ...ways, atMs: beginMs, sinceMs: endMs - (to - beginMs) / rate };

  /** A gentle way back is as long as it takes: what follows it begins when it has. */
  function thenMs(): number | null {
    if (passesLeft === 1) return null;
    if (loopFrom === 1) return atMs[0] ?? 0;
    return passage.returns ? null : beginMs;
  }
}

/** What the board plays: a pass takes it `passMs`, whatever the frames say. */
export interface BoardPlay {
  readonly beganMs: number;
  /** 0: until stopped. */
  readonly times: number;
  readonly passMs: number;
  readonly lengthMs: number;
}

export function boardAt({ beganMs, times, passMs, lengthMs }: BoardPlay, nowMs: number): number {
  const passedMs = nowMs - beganMs;
  const isOver = times > 0 && passedMs >= passMs * times;
  return isOver || passMs === 0 ? lengthMs : ((passedMs % passMs) / passMs) * lengthMs;
}

/** null: it is over. */
export function boardCourse({ beganMs, times, passMs, lengthMs }: BoardPlay, nowMs: number): Course | null {
  const pass = Math.floor((nowMs - beganMs) / passMs);
  if (passMs <= 0 || lengthMs <= 0 || (times > 0 && pass >= times)) return null;
  return {
    ...{ atMs: 0, sinceMs: beganMs + pass * passMs, rate: lengthMs / passMs, untilMs: lengthMs },
    thenMs: times > 0 && pass === times - 1 ? null : 0,
  };
}

/** What is only looked at: a part of the group, over and over. */
export interface PreviewPlay {
  /** The first pass begins here, later ones at `fromMs`. */
  readonly startMs: number;
  readonly fromMs: number;
  readonly toMs: number;
  /** 0: until it is ended. */
  readonly passes: number;
  readonly speedPercent: number;
  readonly beganMs: number;
}

/** null: it is over. */
export function previewAt(play: PreviewPlay, nowMs: number): number | null {
  const course = previewCourse(play, nowMs);
  return course === null ? null : course.atMs + (nowMs - course.sinceMs) * course.rate;
}

/** Of the pass that is on; null: it is over. */
export function previewCourse(play: PreviewPlay, nowMs: number): Course | null {
  const { startMs, fromMs, toMs, passes, beganMs } = play;
  const rate = play.speedPercent / 100;
  const firstMs = (toMs - startMs) / rate;
  const passMs = (toMs - fromMs) / rate;
  const laterMs = nowMs - beganMs - firstMs;
  if (laterMs >= 0 && passMs <= 0) return null;
  const pass = laterMs < 0 ? 0 : 1 + Math.floor(laterMs / passMs);
  if (pass > 0 && passes > 0 && pass >= passes) return null;
  return {
    ...(pass === 0
      ? { atMs: startMs, sinceMs: beganMs }
      : { atMs: fromMs, sinceMs: beganMs + firstMs + (pass - 1) * passMs }),
    ...{ rate, untilMs: toMs },
    thenMs: passes > 0 && pass === passes - 1 ? null : fromMs,
  };
}
