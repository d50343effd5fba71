// What the board's reports say about the motion: answers, positions, the start and the end of groups. Knows reports; what a command
// does is motion.ts.

import type { ServoTarget } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import type { Report, ReportKind } from '../codec/reports.ts';
import { afterPositions, runningUnknown, type KnownBoard, type Motion, LAST_TICKS_MS } from './model.ts';
import { advance, LONGEST_DEAFNESS_MS, playbackOf, restless } from './motion.ts';
import { lastEndMs, stands } from './tracks.ts';

/** A board that says when it takes a run also says when the group has ended (S18, S48, X1). */
export const reportsEnd = ({ answers, runReportsNameSlot }: Family): boolean =>
  answers.includes('run') || runReportsNameSlot;

/** After the board said so at `atMs`; the end of a group is `afterEnd`. */
export function afterReport(motion: Motion, report: Report, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  if (report.kind === 'runStarted') return afterStart(current, report.slot);
  const answered = afterAnswer(current, report.kind, atMs, board);
  const isWord = report.kind === 'positions' || report.kind === 'allPositions';
  return isWord ? afterPositionsReport(answered, report.positions, atMs) : answered;
}

/** It read them a while ago: what may have moved meanwhile it may have read on its way. */
function afterPositionsReport(motion: Motion, positions: readonly ServoTarget[], atMs: number): Motion {
  if (motion.run !== null) return motion;
  const isRestless = atMs < motion.restlessUntilMs + LONGEST_DEAFNESS_MS;
  const standing = positions.filter(({ servo }) => {
    // Without torque it is on no way.
    if (isRestless) return motion.readings.get(servo)?.isReleased ?? false;
    const track = motion.tracks.get(servo);
    return track === undefined || stands(track, atMs);
  });
  return { ...motion, readings: afterPositions(motion.readings, standing) };
}

/** What came while it was deaf it takes up only now: until that is done the next packet may be dropped (S9), or it is deaf again. */
function afterAnswer(motion: Motion, kind: ReportKind, atMs: number, { family }: KnownBoard): Motion {
  const index = motion.answersOwed.indexOf(kind);
  if (index < 0) return motion;
  const answersOwed = motion.answersOwed.toSpliced(index, 1);
  // It took up the command behind the cut packet, so that one is over.
  const answered = { ...motion, answersOwed, maySwallow: 0 };
  if (answersOwed.length > 0) return answered;
  const deafUntilMs = motion.mayHoldPacket ? atMs + family.serviceGapMs : -Infinity;
  return { ...answered, deafUntilMs, mayHoldPacket: false };
}

/** By our own command a moment ago; or it was started at the board, at a time that is uncertain by a tick. */
function afterStart(motion: Motion, slot: number): Motion {
  const { run } = motion;
  const isOurs = run?.kind === 'deadlines' && run.slot === slot && run.next <= 1 && run.loopsDone === 0;
  return isOurs ? motion : runningUnknown(motion, slot);
}

/** After a group has ended by itself, its last frame with it: the one in `slot`, or null where the board does not say which. */
export function afterEnd(motion: Motion, slot: number | null, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  const isAnother = current.run?.kind === 'deadlines' && slot !== null && slot !== current.run.slot;
  // Said so late that the next one runs already.
  if (isAnother) return current;
  return restless(current, playbackOf(board).ended(current, board), atMs, lastFrameMs(current, atMs, board));
}

/** Its last frame is over with it; but a move that left meanwhile has re-timed what that frame moves (S26). */
function lastFrameMs({ tracks }: Motion, atMs: number, { family: { motion } }: KnownBoard): number {
  return LAST_TICKS_MS + (motion.timing === 'shared' ? lastEndMs(tracks, atMs) - atMs : 0);
}

/** After the group was stopped, or is taken to have ended: its frame in progress continues (S50). */
export function afterCut(motion: Motion, atMs: number, board: KnownBoard): Motion {
  const current = advance(motion, atMs, board);
  return restless(current, { ...current, run: null }, atMs);
}
