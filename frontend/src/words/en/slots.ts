// Words about the board's slots: what is in them, as far as anybody can know, and what plays them.

import type { SlotFate } from '#shared/actions/slots/slotBook.ts';
import type { PadButton } from '#shared/protocol/families.ts';
import type { SlotTrigger } from '#shared/protocol/slotMeanings.ts';
import { counted, formatCount, formatNames, formatWhole } from './numbers.ts';

export const slotName = (slot: number): string => `Slot ${formatWhole(slot)}`;

export const buttons: Readonly<Record<PadButton, string>> = {
  ...{ start: 'START', up: 'up', down: 'down', left: 'left', right: 'right' },
  ...{ triangle: 'triangle', cross: 'cross', square: 'square', circle: 'circle' },
  ...{ l1: 'L1', r1: 'R1', l2: 'L2', r2: 'R2' },
};

/** As they stand on the pad itself, where there is little room. */
export const SIGNS: Readonly<Partial<Record<PadButton, string>>> = {
  ...{ triangle: '△', cross: '✕', square: '□', circle: '○' },
};

export const slotWords = {
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
  trigger: (trigger: SlotTrigger): string =>
    trigger.kind === 'pad'
      ? `Played by ${buttons[trigger.button]} of the wireless pad`
      : trigger.kind === 'select'
        ? 'Played by SELECT and a button of the wireless pad'
        : trigger.kind === 'key'
          ? 'Played by the key on the board'
          : `Played by itself when slot ${formatWhole(trigger.after)} has ended`,
  /** In a few words. */
  triggerInBar: (trigger: SlotTrigger): string =>
    trigger.kind === 'pad'
      ? `Pad button ${SIGNS[trigger.button] ?? buttons[trigger.button]}`
      : trigger.kind === 'chain'
        ? `Follows slot ${formatWhole(trigger.after)}`
        : { select: 'Pad button with SELECT', key: 'Key on the board' }[trigger.kind],
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
  job: (done: number, count: number): string => `${formatCount(done)} of ${counted(count, 'group')}`,
  notSaved: 'The browser does not store what is on the board; it is known until the page is closed.',
};
