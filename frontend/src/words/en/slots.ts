// Words about the board's slots: what is in them, as far as anybody can know, and what plays them.

import type { SlotFate } from '#shared/actions/slots/slotBook.ts';
import type { PadButton, SlotTrigger } from '#shared/protocol/slotMeanings.ts';
import { counted, formatCount, formatNames, formatRoughly, formatSeconds, formatWhole } from './numbers.ts';

const slotName = (slot: number): string => `Slot ${formatWhole(slot)}`;
const frameCount = (count: number): string => counted(count, 'frame');

const buttons: Readonly<Record<PadButton, string>> = {
  ...{ start: 'START', up: 'up', down: 'down', left: 'left', right: 'right' },
  ...{ triangle: 'triangle', cross: 'cross', square: 'square', circle: 'circle' },
  ...{ l1: 'L1', r1: 'R1', l2: 'L2', r2: 'R2' },
};

/** As they stand on the pad itself, where there is little room. */
const SIGNS: Readonly<Partial<Record<PadButton, string>>> = {
  ...{ triangle: '△', cross: '✕', square: '□', circle: '○' },
};

const about: Readonly<Record<SlotFate, string>> = {
  arriving: 'Being downloaded',
  broken: 'Broken: its download did not finish',
  same: 'This group, as it is now',
  older: 'This group, an older version',
  other: 'Not this group as it is now',
  empty: 'Empty since everything was erased',
  unknown: 'Unknown: nothing was downloaded from here',
};

/** In a sentence; `name` is the group it holds, as far as anybody noted it. */
const holds = (fate: SlotFate, name: string): string =>
  ({
    arriving: 'Being downloaded.',
    broken: 'Its download did not finish. Download again before running it.',
    same: 'Holds this group, as it is now.',
    older: 'Holds an older version of this group.',
    other: `Holds ${name === '' ? 'another group' : `“${name}”`}, not this group as it is now.`,
    empty: 'Empty since everything was erased.',
    unknown: 'What it holds is unknown; boards cannot be read.',
  })[fate];

export const slotWords = {
  title: 'Slots of the board',
  open: 'Slots',
  map: 'Map of the slots',
  intro:
    'Boards cannot be read. This is what was downloaded from here, or by others over the same gateway; another program may have changed it since.',
  name: slotName,
  cell: (slot: number, fate: SlotFate, name: string | undefined): string =>
    name === undefined ? `${slotName(slot)}: ${about[fate]}` : `${slotName(slot)}: ${name}. ${about[fate]}`,
  about: (fate: SlotFate): string => about[fate],
  holds,
  /** In a few words; `name` as for `holds`. */
  inBar: (fate: SlotFate, name: string): string =>
    ({
      arriving: 'Being downloaded',
      broken: 'Broken',
      same: 'Holds this group',
      older: 'Holds an older copy',
      other: name === '' ? 'Holds another group' : `Holds “${name}”`,
      empty: 'Empty',
      unknown: 'Unknown',
    })[fate],
  badge: {
    arriving: 'Arriving',
    broken: 'Broken',
    same: 'Up to date',
    older: 'Older copy',
    other: 'Stored',
    empty: 'Empty',
    unknown: 'Unknown',
  },
  trigger: (trigger: SlotTrigger): string =>
    trigger.kind === 'pad'
      ? `Played by ${buttons[trigger.button]} of the wireless pad`
      : trigger.kind === 'select'
        ? 'Played by SELECT and a button of the wireless pad'
        : trigger.kind === 'key'
          ? 'Played by the key on the board'
          : `Played by itself when slot ${formatWhole(trigger.after)} has ended`,
  triggerShort: (trigger: SlotTrigger): string =>
    trigger.kind === 'pad'
      ? (SIGNS[trigger.button] ?? buttons[trigger.button])
      : { select: 'SELECT', key: 'key', chain: 'chain' }[trigger.kind],
  /** In a few words. */
  triggerInBar: (trigger: SlotTrigger): string =>
    trigger.kind === 'pad'
      ? `Pad button ${SIGNS[trigger.button] ?? buttons[trigger.button]}`
      : trigger.kind === 'chain'
        ? `Follows slot ${formatWhole(trigger.after)}`
        : { select: 'Pad button with SELECT', key: 'Key on the board' }[trigger.kind],
  stored: (name: string, when: string, count: number, durationMs: number, version: string): string =>
    `${name === '' ? 'Without a name' : name}, ${frameCount(count)}, ${formatSeconds(durationMs)}, downloaded ${when}, version ${version}`,
  /** `size`: null where nobody knows. */
  storedByOthers: (
    name: string,
    by: string,
    when: string | null,
    version: string,
    size: string | null,
  ): string =>
    [
      name === '' ? 'Without a name' : name,
      size,
      by === '' ? 'downloaded elsewhere' : `downloaded by ${by}`,
      when,
      `version ${version}`,
    ]
      .filter((part) => part !== null)
      .join(', '),
  notInLibrary: 'The library does not hold this version: it can be neither compared nor restored from here.',
  replaceTitle: (slots: readonly number[]): string =>
    slots.length === 1
      ? `${slotName(slots[0] ?? 0)} holds another group`
      : `${counted(slots.length, 'slot')} hold other groups`,
  /** `isInLibrary`: what is there can be downloaded again; `trigger`: what plays it. */
  replaceText: (slot: number, held: string, name: string, isInLibrary: boolean, trigger: string): string =>
    [
      `“${name}” takes the place of ${held === '' ? 'the group' : `“${held}”`} in slot ${formatWhole(slot)} of the board.`,
      isInLibrary
        ? `${held === '' ? 'That group' : `“${held}”`} stays in the library.`
        : `${held === '' ? 'That group' : `“${held}”`} is not in the library and is lost.`,
      ...(trigger === '' ? [] : [`${trigger}.`]),
    ].join(' '),
  replaceLeave: 'Leave it as it is',
  replaceFree: (slots: readonly number[]): string =>
    slots.length === 1
      ? `Use slot ${formatWhole(slots[0] ?? 0)} (free)`
      : `Use slots ${formatNames(slots.map((slot) => formatWhole(slot)))} (free)`,
  replace: 'Replace',
  run: 'Run',
  compare: 'Compare',
  same: 'The copy on the board and the group on this page are the same.',
  lengths: (counts: readonly [number, number], durationsMs: readonly [number, number]): string =>
    `On the board ${frameCount(counts[0])}, ${formatSeconds(durationsMs[0])}; here ${frameCount(counts[1])}, ${formatSeconds(durationsMs[1])}.`,
  firstDifferent: (frame: number): string => `Frame ${formatWhole(frame)} is the first one that differs.`,
  differs: (name: string, onBoard: number | null, here: number | null): string =>
    `${name}: ${onBoard === null ? 'not moved' : formatWhole(onBoard)} on the board, ${here === null ? 'not moved' : formatWhole(here)} here`,
  willGo: (groups: readonly { readonly slot: number; readonly name: string }[]): string =>
    `Can be restored afterwards: ${formatNames(groups.map(({ slot, name }) => `${formatWhole(slot)} ${name}`))}.`,
  notRestored: (groups: readonly { readonly slot: number; readonly name: string }[]): string =>
    `Cannot be restored, because the library does not hold the version that was downloaded: ${formatNames(groups.map(({ slot, name }) => `${formatWhole(slot)} ${name}`.trim()))}.`,
  restoreAll: (count: number): string => `Restore all ${formatCount(count)}`,
  restoreHint: 'Downloads again what the last erase took',
  job: (done: number, count: number): string => `${formatCount(done)} of ${counted(count, 'group')}`,
  several: {
    open: 'Download several',
    title: 'Download several groups',
    hint: 'Each goes to its own slot, one after the other.',
    list: 'Groups of the library',
    all: (count: number): string => `All ${formatCount(count)}`,
    about: (count: number, durationMs: number): string =>
      `${frameCount(count)}, ${formatSeconds(durationMs)}`,
    slotOf: (name: string): string => `Slot for ${name}`,
    noFrame: 'It has no frame yet.',
    sameSlot: (slot: number): string => `${slotName(slot)} is wanted twice.`,
    total: (count: number, frames: number, downloadMs: number): string =>
      `${counted(count, 'group')}, ${frameCount(frames)} on the board, about ${formatRoughly(downloadMs)} to download`,
    cannot: (count: number): string =>
      `${counted(count, 'group')} cannot go; what keeps ${count === 1 ? 'it' : 'them'} is said beside ${count === 1 ? 'it' : 'each'}.`,
    none: 'Tick the groups that shall go to the board.',
    download: 'Download these',
    back: 'Back to one slot',
  },
  notSaved: 'The browser does not store what is on the board; it is known until the page is closed.',
};
