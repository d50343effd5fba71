// Has the board play a group by itself: downloads it first where the slot has not just this, as any download that may
// take the place of another group. Judges by the frames that would be written, and says where they are while they run; knows no timeline.

import type { Passage } from '#shared/group/passage.ts';
import { frameEnds } from '#shared/group/tracks.ts';
import { contentOf, recordOf } from '#shared/group/slotBook.ts';
import { passMs } from '#shared/motion/motion.ts';
import type { CompiledGroup, CompiledStore } from '../../board/compile/compiled.ts';
import type { Device } from '../../../robot/device.ts';
import { runAsChosen } from '../../board/runSettings.ts';
import type { GroupPlace } from '../../board/slots/groupPlace.ts';
import type { Replacing } from '../../board/slots/replacing.ts';
import type { Slots } from '../../board/slots/slots.ts';
import type { View } from '../../view.ts';

// Where in a group one is while it plays, in ms of the group: from the page, on the board, or on the drawing alone.
// By the clock; pure.

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
interface BoardPlay {
  readonly beganMs: number;
  /** 0: until stopped. */
  readonly times: number;
  readonly passMs: number;
  readonly lengthMs: number;
}

function boardAt({ beganMs, times, passMs, lengthMs }: BoardPlay, nowMs: number): number {
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

interface BoardRunOptions {
  readonly device: Device;
  readonly compiled: CompiledStore;
  readonly slots: Slots;
  readonly place: GroupPlace;
  readonly replacing: Replacing;
  readonly view: View;
  /** Of the group at hand, in the library. */
  documentId(): string;
  /** null: nothing goes on any more. */
  phase(next: 'storing' | 'running' | null): void;
}

interface BoardRun {
  /** `times` 0: until stopped. */
  begin(group: CompiledGroup, times: number): void;
  /** By the clock since the board took it; null where it is not this group that runs. */
  at(): number | null;
}

export function createBoardRun(options: BoardRunOptions): BoardRun {
  const { device, compiled, slots, place, replacing, view, documentId, phase } = options;

  function run(slot: number, times: number): void {
    phase('running');
    runAsChosen({ device, view }, slot, times, (isTaken) => {
      if (!isTaken) phase(null);
    });
  }

  function begin(group: CompiledGroup, times: number): void {
    const { slot } = place.store.getState();
    const { book } = slots.store.getState();
    const { brokenSlots, slotVersions } = device.store.getState().snapshot;
    const own = { name: group.source.group.name, documentId: documentId() };
    const now = { broken: brokenSlots, arriving: null, versions: slotVersions ?? {} };
    if (contentOf(book, now, slot, { ...group, ...own }) === 'same') return run(slot, times);
    let to = slot;
    replacing.download([{ slot, ...own, frames: group.frames }], {
      began([stored]) {
        to = stored?.slot ?? slot;
        view.setState({ slot: to });
        phase('storing');
      },
      settled(isDone) {
        if (isDone) run(to, times);
        else phase(null);
      },
    });
  }

  function at(): number | null {
    const now = device.store.getState().snapshot.activity;
    if (now.kind !== 'running') return null;
    const { latest } = compiled.store.getState();
    const record = recordOf(slots.store.getState().book, now.slot);
    if ((record?.fingerprint ?? slots.versionIn(now.slot)) !== latest.fingerprint) return null;
    const play = {
      ...{ beganMs: now.sinceMs, times: now.times },
      passMs: passMs(latest.frames, { family: latest.source.family, playedFrames: () => null }),
      lengthMs: frameEnds(latest.frames).at(-1) ?? 0,
    };
    return Math.round(boardAt(play, device.clock.now()));
  }

  return { begin, at };
}
