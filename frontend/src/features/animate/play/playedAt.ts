// Where in a group one is while it plays, in ms of the group: from the page, on the board, or on the drawing alone. By the clock;
// pure, knows neither robot nor page.

import type { Passage } from '#shared/group/passage.ts';

/** What plays from the page: which frame of its passage began when. */
export interface PagePlay {
  readonly passage: Passage;
  readonly index: number;
  readonly beganMs: number;
  /** Gently on the way to the first pose, which is where one then is. */
  readonly isLead: boolean;
}

export function pageAt({ passage, index, beganMs, isLead }: PagePlay, nowMs: number): number {
  const { frames, atMs, beginMs } = passage;
  const to = atMs[index] ?? 0;
  const durationMs = frames[index]?.durationMs ?? 0;
  const from = index === 0 ? (isLead ? to : beginMs) : (atMs[index - 1] ?? 0);
  const share = durationMs === 0 ? 1 : Math.min(1, (nowMs - beganMs) / durationMs);
  return from + (to - from) * share;
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
  const { startMs, fromMs, toMs, passes } = play;
  const passedMs = ((nowMs - play.beganMs) * play.speedPercent) / 100;
  if (startMs + passedMs < toMs) return startMs + passedMs;
  const lengthMs = toMs - fromMs;
  const laterMs = startMs + passedMs - toMs;
  const isOver = passes > 0 && laterMs >= lengthMs * (passes - 1);
  return isOver || lengthMs <= 0 ? null : fromMs + (laterMs % lengthMs);
}
