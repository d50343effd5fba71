// Which slots a board plays by itself, and what makes it: buttons of the wireless pad, the board's own key, the end of another
// group. Source: S49, S55, S56, X8, L2 in boards.md.

import type { BoardId, Range } from './families.ts';

export type SlotTrigger =
  | { readonly kind: 'pad'; readonly button: PadButton }
  /** A button together with SELECT; the manual does not say which. */
  | { readonly kind: 'select' }
  | { readonly kind: 'key' }
  /** Played once when the slot before it has ended by itself. */
  | { readonly kind: 'chain'; readonly after: number };

export const PAD_BUTTONS = [
  ...(['start', 'up', 'down', 'left', 'right', 'triangle', 'cross', 'square', 'circle'] as const),
  ...(['l1', 'r1', 'l2', 'r2'] as const),
] as const;
export type PadButton = (typeof PAD_BUTTONS)[number];

const KEY_SLOT = 100;

type Meaning = readonly [slot: number, trigger: SlotTrigger];

const pad = (buttons: readonly PadButton[]): readonly Meaning[] =>
  buttons.map((button) => [PAD_BUTTONS.indexOf(button), { kind: 'pad', button }]);

const select = [13, 14, 15, 16, 17, 18].map((slot): Meaning => [slot, { kind: 'select' }]);
const key: Meaning = [KEY_SLOT, { kind: 'key' }];
const chain: Meaning = [KEY_SLOT + 1, { kind: 'chain', after: KEY_SLOT }];

const open = [...pad(PAD_BUTTONS), key, chain];
const closed = [...pad(PAD_BUTTONS), ...select, key];
const leArm: readonly Meaning[] = [[17, { kind: 'key' }]];

const MEANINGS: Readonly<Partial<Record<BoardId, readonly Meaning[]>>> = {
  doc: open,
  'openarm-old': [...pad(PAD_BUTTONS.filter((button) => button !== 'square')), key],
  'openarm-new': open,
  'lsc-6': closed,
  'lsc-16': closed,
  'lsc-24': closed,
  'lsc-32': closed,
  'bus-ctrl': closed,
  xarm: closed,
  'learm-esp32': leArm,
  'learm-esp32-bus': leArm,
};

/**
 * What some board plays without being asked, or comes filled with from its maker: pad buttons and factory groups (S56, X8, boards.md
 * chapter 9), the key and the slots that follow it by themselves (S49, S55). Of which board one has is not sure enough to differ.
 */
const LIVE: readonly Range[] = [
  { min: 0, max: 20 },
  { min: 100, max: 110 },
];

export const isLiveSlot = (slot: number): boolean => LIVE.some(({ min, max }) => slot >= min && slot <= max);

/** null: only a run on purpose plays it. */
export function slotTrigger(board: BoardId, slot: number): SlotTrigger | null {
  return MEANINGS[board]?.find(([number]) => number === slot)?.[1] ?? null;
}
