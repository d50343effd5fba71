// What the timeline shows and has selected on this screen: nothing of it is the document's, none of it moves the robot. The
// playhead is an instant one looks at; whoever plays may move it.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clip } from '#shared/group/clip.ts';
import { NO_KEYS, type KeySet } from './keySet.ts';

/** The instant at the left end of the lanes, and how much time a pixel is. */
export interface TimeView {
  readonly fromMs: number;
  readonly msPerPx: number;
}

/** Where the keyboard is: a row, and the frame in it; null where the row has no key. */
export interface Cursor {
  readonly row: string;
  readonly frameId: number | null;
}

/** A number or text that the person is asked for, in place. */
export const ASKS = [
  'value',
  'scaleTime',
  'scaleTimeBack',
  'scaleAmplitude',
  'insertTime',
  'note',
  'marker',
] as const;
export type Ask = (typeof ASKS)[number];

export interface TimelineState {
  readonly selected: KeySet;
  readonly cursor: Cursor;
  readonly playheadMs: number;
  /** What is played again and again; null: all of it, once. */
  readonly range: { readonly fromMs: number; readonly toMs: number } | null;
  readonly time: TimeView;
  /** All of the group stays in sight, until the person zooms or pans. */
  readonly followsGroup: boolean;
  /** Of the lanes; 0 before they are drawn. */
  readonly widthPx: number;
  readonly heightPx: number;
  /** How far the rows are scrolled. */
  readonly scrollTop: number;
  readonly isTall: boolean;
  readonly snaps: boolean;
  readonly ripples: boolean;
  /** The body shows the pose at the playhead. */
  readonly showsPreview: boolean;
  readonly clip: Clip | null;
  readonly asks: Ask | null;
  /** The answer as far as it was typed before its field was there. */
  readonly typed: string;
  /** The marker that is selected, by its id. */
  readonly marker: number | null;
}

export type Timeline = StoreApi<TimelineState>;

export const ALL_ROW = 'all';

export function createTimeline(): Timeline {
  return createStore<TimelineState>(() => ({
    ...afresh(),
    time: { fromMs: 0, msPerPx: 10 },
    widthPx: 0,
    heightPx: 0,
    scrollTop: 0,
    isTall: false,
    snaps: true,
    ripples: false,
    showsPreview: true,
    clip: null,
  }));
}

/** What is about one group and means nothing in another. */
export function afresh() {
  return {
    selected: NO_KEYS,
    cursor: { row: ALL_ROW, frameId: null },
    playheadMs: 0,
    range: null,
    followsGroup: true,
    asks: null,
    typed: '',
    marker: null,
  } satisfies Partial<TimelineState>;
}
