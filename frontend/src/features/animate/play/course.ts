// Where in a group one is while it plays, in ms of the group: from the page, on the board, or on the drawing alone; as a place at a time,
// and as the line over the clock that a sound follows. Pure.

import type { Passage } from '#shared/group/passage.ts';
import { FIRST_MOVE_MS } from '#shared/robot/timings.ts';
import type { Course } from '../sound/soundPlayer.ts';
import type { PlayedSpan } from './playback.ts';

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
