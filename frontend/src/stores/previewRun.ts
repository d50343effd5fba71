// Where the playhead is while a group is only looked at: by the clock, once or over and over. Sends nothing; knows no group.

export interface PreviewRun {
  /** The first pass begins here, later ones at `fromMs`. */
  readonly startMs: number;
  readonly fromMs: number;
  readonly toMs: number;
  /** 0: until it is ended. */
  readonly passes: number;
  readonly speedPercent: number;
  readonly beganMs: number;
}

/** In ms of the group; null: it is over. */
export function previewedAt(run: PreviewRun, nowMs: number): number | null {
  const { startMs, fromMs, toMs, passes } = run;
  const passedMs = ((nowMs - run.beganMs) * run.speedPercent) / 100;
  if (startMs + passedMs < toMs) return startMs + passedMs;
  const lengthMs = toMs - fromMs;
  const laterMs = startMs + passedMs - toMs;
  const isOver = passes > 0 && laterMs >= lengthMs * (passes - 1);
  return isOver || lengthMs <= 0 ? null : fromMs + (laterMs % lengthMs);
}
