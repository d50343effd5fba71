// What the timeline shows and has selected on this screen, and how undo, redo and another group change that. Nothing of it is the
// document's, none of it moves the robot. The playhead is the time that is shown; the player may move it.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Range } from '#shared/codec/families.ts';
import type { GroupTimes } from '#shared/group/groupTimes.ts';
import type { Key, KeyRef } from '#shared/group/tracks.ts';
import type { Clip } from '#shared/group/clip.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import type { History } from '#shared/document/history.ts';
import type { Library } from '../../library/library.ts';
import type { View } from '../../view.ts';
import { setChanged } from '../../../state/store.ts';
import type { Document } from '../../groupDocument.ts';

// A set of keys of the action group, by their names in the document.

/** `frameId/servo`, so that a key is found in it at once, however many there are. */
type KeyName = `${number}/${number}`;
export type KeySet = ReadonlySet<KeyName>;

export const NO_KEYS: KeySet = new Set();

export const keyName = ({ frameId, servo }: KeyRef): KeyName => `${frameId}/${servo}`;

/** Made once for each list: thousands of names are not written again after each edit. */
const made = new WeakMap<readonly KeyRef[], KeySet>();
const madeOf = new WeakMap<KeySet, readonly KeyRef[]>();
/** And what each says, read once. */
const read = new WeakMap<KeySet, FramesByServo>();

type FramesByServo = ReadonlyMap<number, ReadonlySet<number>>;

export function keySet(refs: readonly KeyRef[]): KeySet {
  const keys = made.get(refs) ?? new Set(refs.map(keyName));
  isMadeOf(keys, refs);
  return keys;
}

/** `refs` are the keys of the set. */
export function isMadeOf(keys: KeySet, refs: readonly KeyRef[]): void {
  made.set(refs, keys);
  madeOf.set(keys, refs);
}

/** In which frames a servo's key is in the set. */
export function framesByServo(keys: KeySet): FramesByServo {
  const frames = read.get(keys) ?? framesNamedIn(keys);
  read.set(keys, frames);
  return frames;
}

function framesNamedIn(keys: KeySet): FramesByServo {
  const frames = new Map<number, Set<number>>();
  for (const { frameId, servo } of refsOf(keys)) {
    const own = frames.get(servo);
    if (own === undefined) frames.set(servo, new Set([frameId]));
    else own.add(frameId);
  }
  return frames;
}

export const refsOf = (keys: KeySet): readonly KeyRef[] => madeOf.get(keys) ?? namedIn(keys);

function namedIn(keys: KeySet): readonly KeyRef[] {
  return [...keys].map((name) => {
    const [frameId = 0, servo = 0] = name.split('/').map(Number);
    return { frameId, servo };
  });
}

/** `adds`: beside those that are in it; `toggles`: the same, and all of them out where all were in. */
export type SelectMode = 'replaces' | 'adds' | 'toggles';

export function withKeys(before: KeySet, refs: readonly KeyRef[], mode: SelectMode): KeySet {
  const wanted = refs.map(keyName);
  if (mode === 'replaces') return new Set(wanted);
  const areIn = wanted.length > 0 && wanted.every((name) => before.has(name));
  if (mode === 'adds' || !areIn) return new Set([...before, ...wanted]);
  const out = new Set(wanted);
  return new Set([...before].filter((name) => !out.has(name)));
}

const selections = new WeakMap<GroupTimes, WeakMap<KeySet, readonly Key[]>>();

/** Those of the set that are there, servo by servo; worked out once, however many ask. */
export function selectedKeys(times: GroupTimes, selected: KeySet): readonly Key[] {
  const ofTimes = selections.get(times) ?? new WeakMap<KeySet, readonly Key[]>();
  selections.set(times, ofTimes);
  const keys = ofTimes.get(selected) ?? keysNamed(times, selected);
  ofTimes.set(selected, keys);
  return keys;
}

/** Each servo's keys are read once, in the order of time, however the names come. */
function keysNamed({ tracks }: GroupTimes, selected: KeySet): readonly Key[] {
  const frames = framesByServo(selected);
  const servos = [...frames.keys()].sort((one, other) => one - other);
  const keys = servos.flatMap((servo) => {
    const wanted = frames.get(servo);
    return tracks.get(servo)?.keys.filter(({ frameId }) => wanted?.has(frameId)) ?? [];
  });
  if (keys.length === selected.size) isMadeOf(selected, keys);
  return keys;
}

/** The instant at the left end of the tracks, and how much time a pixel is. */
export interface TimeView {
  readonly fromMs: number;
  readonly msPerPx: number;
}

/** Where the keyboard is: a row, and the frame in it; null where the row has no key. */
export interface Cursor {
  readonly row: string;
  readonly frameId: number | null;
}

/** A number or text that the person enters in place. */
const QUESTIONS = [
  'value',
  'scaleTime',
  'scaleTimeBack',
  'scaleAmplitude',
  'insertTime',
  'curve',
  'note',
  'marker',
] as const;
export type Ask = (typeof QUESTIONS)[number];

/** A row that is open large, and the part of its range that its height stands for. */
export interface LargeRow extends Range {
  readonly servo: number;
}

export interface TimelineState {
  readonly selected: KeySet;
  readonly cursor: Cursor;
  readonly playheadMs: number;
  /** What is played again and again; null: all of it, once. */
  readonly range: { readonly fromMs: number; readonly toMs: number } | null;
  readonly time: TimeView;
  /** All of the group stays in sight, until the person zooms or pans. */
  readonly followsGroup: boolean;
  /** Of the tracks; 0 before they are drawn. */
  readonly widthPx: number;
  readonly heightPx: number;
  /** How far the rows are scrolled. */
  readonly scrollTop: number;
  readonly isTall: boolean;
  /** Each row shows the range of its motion, not all that its servo may do. */
  readonly fitsRows: boolean;
  readonly large: LargeRow | null;
  readonly snaps: boolean;
  readonly ripples: boolean;
  /** The body shows the pose at the playhead. */
  readonly showsPreview: boolean;
  readonly clip: Clip | null;
  readonly question: Ask | null;
  /** The answer as far as it was typed before its field was there. */
  readonly typed: string;
  /** The marker that is selected, by its id. */
  readonly marker: number | null;
}

export type Timeline = StoreApi<TimelineState>;

export const ALL_ROW = 'all';

export function createTimeline(): Timeline {
  return createStore<TimelineState>(() => ({
    ...initialSelection(),
    time: { fromMs: 0, msPerPx: 10 },
    widthPx: 0,
    heightPx: 0,
    scrollTop: 0,
    isTall: false,
    fitsRows: true,
    snaps: true,
    ripples: false,
    showsPreview: true,
    clip: null,
  }));
}

/** The part of the state that belongs to one group. */
export function initialSelection() {
  return {
    selected: NO_KEYS,
    cursor: { row: ALL_ROW, frameId: null },
    playheadMs: 0,
    range: null,
    followsGroup: true,
    question: null,
    typed: '',
    marker: null,
    large: null,
  } satisfies Partial<TimelineState>;
}

/**
 * When another group is opened, nothing of it is selected yet, all of it is in sight, and the playhead is at its beginning: frames of two
 * groups may have the same ids.
 */
export function resetForOpenedGroup(stores: {
  readonly library: Pick<Library, 'store'>;
  readonly view: View;
  readonly timeline: Timeline;
}): void {
  stores.library.store.subscribe(({ openId }, before) => {
    if (openId === before.openId) return;
    stores.view.setState({ selectedFrame: null });
    stores.timeline.setState(initialSelection());
  });
}

interface SelectionStores {
  readonly document: Document;
  readonly timeline: Timeline;
  readonly view: View;
}

/** Undo, redo and a cancelled gesture bring back the selection and the cursor that the group was left with. */
export function restoreSelection({ document, timeline, view }: SelectionStores): void {
  const left = new WeakMap<ActionGroup, ReturnType<typeof looks>>();

  function looks() {
    const { selected, cursor, marker } = timeline.getState();
    return { keys: { selected, cursor, marker }, selectedFrame: view.getState().selectedFrame };
  }

  document.store.subscribe((next, before) => {
    if (next.present === before.present) return;
    left.set(before.present, looks());
    const back = isStep(before, next) || isCalledOff(before, next) ? left.get(next.present) : undefined;
    if (back === undefined) return;
    setChanged(timeline, back.keys);
    setChanged(view, { selectedFrame: back.selectedFrame });
  });
}

/** Back or forth in the history, and no edit. */
function isStep(before: History<ActionGroup>, next: History<ActionGroup>): boolean {
  return next.future.at(-1)?.value === before.present || before.future.at(-1)?.value === next.present;
}

function isCalledOff({ gesture }: History<ActionGroup>, next: History<ActionGroup>): boolean {
  return gesture !== null && next.gesture === null && next.present === gesture.value;
}
