// Words about the board's slots: what is in them, as far as anybody can know, and what plays them.

import type { SlotFate } from '#shared/actions/slots/slotBook.ts';
import type { SlotTrigger } from '#shared/protocol/slotMeanings.ts';
import { counted, formatCount, formatNames, formatRoughly, formatSeconds, formatWhole } from '../numbers.ts';
import { slotWords, slotName, SIGNS, buttons } from '../slots.ts';

const frameCount = (count: number): string => counted(count, 'frame');

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

export const wholeSlotWords = {
  ...slotWords,
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
  badge: {
    arriving: 'Arriving',
    broken: 'Broken',
    same: 'Up to date',
    older: 'Older copy',
    other: 'Stored',
    empty: 'Empty',
    unknown: 'Unknown',
  },
  triggerShort: (trigger: SlotTrigger): string =>
    trigger.kind === 'pad'
      ? (SIGNS[trigger.button] ?? buttons[trigger.button])
      : { select: 'SELECT', key: 'key', chain: 'chain' }[trigger.kind],
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
};
