// Board families: what a board of each kind takes, answers and means, and which slots it plays by itself. One table for codec,
// session, simulator and page, and the same for the gateway: shared/protocol/families.json, with the source of each figure. What
// differs between boards is a field there, never an `if` on a family elsewhere.

import data from '../../protocol/families.json' with { type: 'json' };
import type { CommandKind } from './commands.ts';

export interface Range {
  readonly min: number;
  readonly max: number;
}

export interface Family {
  readonly id: BoardId;
  /** Shown to people; a proper name, the same in every language. */
  readonly name: string;
  readonly unit: 'us' | 'steps';
  readonly position: Range;
  /** Servos that may turn less far than `position` says; `positionRange` knows both. */
  readonly servoPosition: Readonly<Partial<Record<number, Range>>>;
  /** Centre of the position range, where a servo is at rest. */
  readonly centre: number;
  /** Servo numbers the board accepts in a packet. */
  readonly servo: Range;
  /** How many servos such a robot usually has, numbered from 1: the sliders of the page. */
  readonly usualServoCount: number;
  readonly servosPerMove: number;
  readonly servosPerFrame: number;
  /** Move and frame time. Shorter moves take the minimum step of the board, longer ones are cut by it (S25). */
  readonly durationMs: Range;
  readonly shortestMoveMs: number;
  readonly framesPerGroup: number;
  readonly slot: Range;
  readonly runTimes: Range;
  /** Where the group speed cannot be set, it is what it is. */
  readonly speedPercent: Range;
  /** What the board makes of `times` 0; where that is not endless, `runTimes` leaves it out. */
  readonly zeroTimes: 'endless' | 'once';
  /** Largest LEN that is safe to send. */
  readonly maxLength: number;
  readonly commands: readonly CommandKind[];
  /** LEN of the erase command: with a reserved byte or without. */
  readonly eraseLength: 2 | 3;
  /** Commands the board answers; the others are silent by design. */
  readonly answers: readonly CommandKind[];
  /**
   * Harmless questions that every such board answers, the cheapest first: the others may stay silent for good reasons. What
   * distinguishes the families (boards.md 2.5), and whether a board is still there.
   */
  readonly certainAnswers: readonly Question[];
  /** Reports of runs name slot and times (6 and 8 with LEN 5), whichever client began the run; otherwise they are empty. */
  readonly runReportsNameSlot: boolean;
  /** What an empty packet 7 says: opposite things per family (boards.md 2.4). */
  readonly emptySeven: 'runFinished' | 'runStopped' | 'unknown';
  /** Any question ends a running group, unsaid (L8): ask only while nothing runs. */
  readonly queryKillsRun: boolean;
  /** So many bytes of what comes next a board takes at most for the rest of a packet that was cut before (S3, L3). */
  readonly leftOverBytes: number;
  /** The question whose answer proves that the board hears its stops; null where it may stay silent for good reasons. */
  readonly stopConfirmedBy: Question | null;
  /** What frees a parser that waits for the rest of a cut packet (S7); null where that may do harm. */
  readonly resyncFiller: number | null;
  /** Command numbers that must not go out, not even by hand: they write settings, move, or their meaning is unknown. */
  readonly neverSend: readonly number[];
  /** Numbers it does not know do nothing at all there (S5); elsewhere it is unknown what they do. */
  readonly ignoresUnknown: boolean;
  /** Pause the board needs between two packets, after the last byte has left the wire (S52, S54). */
  readonly serviceGapMs: number;
  readonly motion: MotionTraits;
  /** Reported values above this are not measured; null where no such ceiling is known. */
  readonly batteryCeilingMv: number | null;
  /** The button of the wireless pad that plays slot 0, 1 …; null: none does. */
  readonly padButtons: readonly (PadButton | null)[];
  /** Played by a button together with SELECT. */
  readonly selectSlots: readonly number[];
  /** Played by the board's own key. */
  readonly keySlot: number | null;
}

/** How a board turns its servos and plays its groups: what the motion estimate has to know of it. */
interface MotionTraits {
  readonly tickMs: number;
  /**
   * The longest that its loop is busy without being deaf to us: with what it says (S21), a pad's poll (S52), entries handed on to
   * bus servos (S31). Its servos wait that long, and what came meanwhile is late (S29).
   */
  readonly talkMs: number;
  /**
   * `shared`: any new target re-times every servo (S26). `perServo`: one that starts leaves the others alone. `unknown`: no source says which,
   * so a packet carries every servo under way and both readings give the same motion.
   */
  readonly timing: 'shared' | 'perServo' | 'unknown';
  /** A longer move leaves in parts of that time at most; null where it leaves as one packet. */
  readonly partMs: number | null;
  /** `deadlines`: a frame takes its time, to the millisecond (S42). `polled`: the next begins some time behind it (L7). */
  readonly groups: 'deadlines' | 'polled';
  /** A stop halts these where they are; the others go on to the end of their frame (S50, L9). */
  readonly haltedByStop: readonly number[];
  /** When the group in this slot ends by itself, the next one is played once (S49). */
  readonly chainedSlot: number | null;
}

/** Queries that any board may get: it moves nothing, stores nothing and makes nothing drop. */
export type Question = Extract<CommandKind, 'readBattery' | 'readVersion' | 'readPositions'>;

/** `unknown` until a board has been identified. */
export type BoardId = FamilyId | 'unknown';

export type FamilyId = keyof typeof data.families;

type PadButton =
  | ('start' | 'up' | 'down' | 'left' | 'right')
  | ('triangle' | 'cross' | 'square' | 'circle')
  | ('l1' | 'r1' | 'l2' | 'r2');

/** A row of the table says what differs from its base. */
interface Row extends Partial<Omit<Family, 'id' | 'motion'>> {
  readonly base?: string;
  readonly motion?: Partial<MotionTraits>;
  readonly why?: Readonly<Record<string, string>>;
}

const BASES = data.bases as unknown as Readonly<Record<string, Row>>;

/** A row with all that it has from its bases; a test proves that nothing is missing. */
function expanded(id: BoardId, row: Row): Family {
  const { base, why: _, motion, ...own } = row;
  const under = base === undefined ? undefined : expanded(id, BASES[base] ?? {});
  return { ...under, ...own, id, motion: { ...under?.motion, ...motion } } as Family;
}

export const FAMILIES = Object.fromEntries(
  Object.entries(data.families).map(([id, row]) => [id, expanded(id as FamilyId, row as unknown as Row)]),
) as unknown as Readonly<Record<FamilyId, Family>>;

/** A board that is not identified yet: harmless questions and the stop, nothing that moves or stores. */
export const UNKNOWN_BOARD = expanded('unknown', data.unknown as unknown as Row);

export function family(id: BoardId): Family {
  return id === 'unknown' ? UNKNOWN_BOARD : FAMILIES[id];
}

/** How far this servo may be turned. */
export function positionRange({ position, servoPosition }: Family, servo: number): Range {
  return servoPosition[servo] ?? position;
}

// Which slots a board plays by itself, and what makes it: buttons of the wireless pad, the board's own key, the end
// of another group. Source: S49, S55, S56, X8, L2 in boards.md.

export type SlotTrigger =
  | { readonly kind: 'pad'; readonly button: PadButton }
  /** A button together with SELECT; the manual does not say which. */
  | { readonly kind: 'select' }
  | { readonly kind: 'key' }
  /** Played once when the slot before it has ended by itself. */
  | { readonly kind: 'chain'; readonly after: number };

/**
 * What some board plays by itself, or comes filled with from its maker: pad buttons and factory groups (S56, X8, boards.md
 * chapter 9), the key and the slots that follow it by themselves (S49, S55). Of which board one has is not sure enough to differ.
 */
const LIVE: readonly Range[] = [
  { min: 0, max: 20 },
  { min: 100, max: 110 },
];

export const isLiveSlot = (slot: number): boolean => LIVE.some(({ min, max }) => slot >= min && slot <= max);

/** null: only a run on purpose plays it. */
export function slotTrigger(board: BoardId, slot: number): SlotTrigger | null {
  const { padButtons, selectSlots, keySlot, motion } = family(board);
  const button = padButtons[slot] ?? null;
  if (button !== null) return { kind: 'pad', button };
  if (selectSlots.includes(slot)) return { kind: 'select' };
  if (keySlot === null) return null;
  if (slot === keySlot) return { kind: 'key' };
  return keySlot === motion.chainedSlot && slot === keySlot + 1 ? { kind: 'chain', after: keySlot } : null;
}
