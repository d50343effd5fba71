// What is played and how, with a call for each frame of the screen and for a page that is hidden. The player comes with the
// panel that has the buttons for it, see `playerOf`. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Timeline } from '../timeline/timeline.ts';
import { paged } from '../timeline/timeScale.ts';
import type { Device } from '../../../robot/device.ts';
import type { View } from '../../view.ts';
import type { CompiledStore } from '../../board/compile/compiled.ts';
import type { Document } from '../../groupDocument.ts';
import type { Notices } from '../../../state/notices.ts';
import type { RobotStore } from '../../profiles/robots.ts';
import type { GroupPlace } from '../../board/slots/groupPlace.ts';
import type { Replacing } from '../../board/slots/replacing.ts';
import type { Slots } from '../../board/slots/slots.ts';

// The timeline's playhead, for the player of the group.

/** The time that is shown, and the part of the group to play; null: all of it. */
export interface Playhead {
  at(): number;
  /** Without scrolling: a person who looks elsewhere is not interrupted. */
  go(atMs: number): void;
  /** Brought into sight. */
  show(atMs: number): void;
  range(): { readonly fromMs: number; readonly toMs: number } | null;
}

export function createPlayhead(timeline: Timeline): Playhead {
  return {
    at: () => timeline.getState().playheadMs,
    go: (playheadMs) => timeline.setState({ playheadMs }),
    show: (playheadMs) =>
      timeline.setState(({ time, widthPx }) => ({ playheadMs, time: paged(time, playheadMs, widthPx) })),
    range: () => timeline.getState().range,
  };
}

/** `leading`: gently on the way to the first pose. `returning`: gently back there, in a loop. `storing`: the board gets the group first. `previewing`: only on the drawing. `recording`: servos that are not played are recorded. */
export type PlaybackPhase =
  | 'leading'
  | 'returning'
  | 'playing'
  | 'recording'
  | 'storing'
  | 'running'
  | 'previewing';

export interface PlaybackState {
  readonly speedPercent: number;
  readonly loops: boolean;
  /** The robot follows the pose at the playhead. */
  readonly isLive: boolean;
  /** null: nothing is played by this. */
  readonly phase: PlaybackPhase | null;
}

/** `fromMs` null: from the beginning; `times` 0: until stopped. */
interface NextPlay {
  readonly fromMs: number | null;
  readonly times: number;
}

/** The part of the group that was played, without the way to its first pose. */
export interface PlayedSpan {
  readonly fromMs: number;
  readonly toMs: number;
  /** On the clock. */
  readonly beganMs: number;
  /** Of the group a millisecond. */
  readonly rate: number;
}

/** Servos that are left to the user while all others play, once. */
export interface Overdub {
  readonly servos: readonly number[];
  /** null: a stop, a lost link or a hidden page ended it, another group was opened, or it did not begin. Otherwise it is over or was paused. */
  ended(span: PlayedSpan | null): void;
}

export interface Player {
  set(change: Partial<Pick<PlaybackState, 'speedPercent' | 'loops' | 'isLive'>>): void;
  /** What playing would do now. */
  next(): NextPlay;
  play(overdub?: Overdub): void;
  /** Plays, or pauses what plays. */
  toggle(): void;
  /** Plays on the drawing alone, or pauses what plays. Needs no robot and moves none. */
  togglePreview(): void;
  /** Downloads first where the board has not just this, and requests confirmation before another group is replaced. */
  runOnBoard(): void;
  /** Where it is; a group on the board ends after its frame in progress. */
  pause(): void;
  /** To the end of the next frame of the group, or of the one before, or to the beginning; the robot goes along where it follows. */
  step(direction: 1 | -1): void;
  /** The group's sound alone, from its beginning, while nothing else plays. */
  listen(isOn: boolean): void;
  /** What of the group's time is heard right now; null: nothing plays. */
  heardAt(): number | null;
  /** To be called while the page is drawn: moves the playhead, and the robot where it follows. */
  frame(): void;
  /** The page is not looked at any more. */
  hidden(): void;
}

export interface Playback {
  readonly store: StoreApi<PlaybackState>;
  /** To be called while the page is drawn: moves the playhead, and the robot where it follows. */
  frame(): void;
  /** The page is not looked at any more. */
  hidden(): void;
  /** The one player of this page; made when it is first needed. */
  player(make: (options: PlaybackOptions, store: StoreApi<PlaybackState>) => Player): Player;
}

export interface PlaybackOptions {
  readonly device: Device;
  readonly document: Document;
  readonly compiled: CompiledStore;
  readonly slots: Slots;
  readonly place: GroupPlace;
  readonly replacing: Replacing;
  readonly notices: Notices;
  readonly view: View;
  readonly playhead: Playhead;
  readonly robots: RobotStore;
  /** Of the open group, in the library. */
  documentId(): string;
}

export function createPlayback(options: PlaybackOptions): Playback {
  const store = createStore<PlaybackState>(() => ({
    ...{ speedPercent: 100, loops: false, isLive: false, phase: null },
  }));
  let player: Player | null = null;
  return {
    store,
    frame: () => player?.frame(),
    hidden: () => player?.hidden(),
    player: (make) => (player ??= make(options, store)),
  };
}
