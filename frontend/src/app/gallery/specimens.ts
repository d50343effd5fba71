// The states of the page as one table: snapshot, positions, group and selection. Defaults: a cable, a board that is ready, servos at rest,
// no frame.

import type { FamilyId } from '#shared/codec/families.ts';
import { identityFrom } from '#shared/robot/identity.ts';
import { LINK_ERROR_CODES } from '#shared/robot/linkError.ts';
import type { Unheld } from '#shared/motion/haltPlan.ts';
import type { Latch, SessionState } from '#shared/robot/state.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import type { Way } from '../../robot/device.ts';
import { SERVO_SPECIMENS, type ServoSpecimen } from './servoSpecimens.ts';
import {
  BATTERY_MESSAGES,
  codeOf,
  DOWNLOADING,
  DOWNLOADING_SEVERAL,
  FEEDS,
  lost,
  NO_BATTERY,
  READY,
  refused,
  REMOTE,
  reported,
  running,
  SIMULATED,
  LEASES,
  UNSURE,
  VERSION_MESSAGES,
  WATCHED,
  type BatteryFeed,
  type Pose,
} from './states.ts';

/** The top bar with the status line, live control, the action group, board and battery, the log. */
export type Part = 'bar' | 'live' | 'group' | 'board' | 'log';

export interface Specimen {
  readonly name: string;
  /** The parts that differ from other states; all if absent. */
  readonly shows?: readonly Part[];
  /** If absent, the usual robot of the board. */
  readonly robot?: ServoSpecimen;
  readonly board?: FamilyId;
  /** The family of the board is unknown. */
  readonly isUnknown?: boolean;
  readonly nickname?: string;
  readonly groupName?: string;
  readonly way?: Way | null;
  readonly state?: SessionState;
  readonly pose?: Pose;
  readonly frames?: number;
  readonly selectedFrame?: number;
  readonly feed?: BatteryFeed;
  /** The last targets of an earlier visit. */
  readonly lastPositions?: Readonly<Record<number, number>>;
}

type Shows = Required<Pick<Specimen, 'shows'>>;

const BAR: Shows = { shows: ['bar'] };
const DRIVEN: Shows = { shows: ['bar', 'live'] };
const STORED: Shows = { shows: ['bar', 'board'] };
const WITH_MESSAGES: Shows = { shows: ['bar', 'live', 'board'] };

const LATCHED = { pose: 'moving', frames: 3, ...DRIVEN } as const;

/** Why nothing moves, and the details of the stop. */
const latched = (
  reason: Latch['reason'],
  stop: Latch['stop'],
  unheld: Unheld | null = null,
): SessionState => ({
  ...READY,
  latch: { reason, by: reason === 'elsewhere' ? 'Cleo' : null, stop, unheld },
});

export const SPECIMENS: readonly Specimen[] = [
  { name: 'Disconnected', way: null, state: INITIAL_STATE, pose: 'unknown' },
  { name: 'Opening', state: { ...INITIAL_STATE, link: { status: 'opening' } }, pose: 'unknown', ...DRIVEN },
  {
    name: 'Ready, nothing known',
    way: SIMULATED,
    state: { ...READY, battery: { kind: 'unread' } },
    pose: 'unknown',
  },
  {
    name: 'Ready, last pose known',
    pose: 'unknown',
    lastPositions: { 1: 1450, 2: 1500, 3: 1950, 4: 2050, 5: 1150, 6: 1700 },
    ...DRIVEN,
  },
  {
    name: 'Starting one after another',
    state: { ...READY, waitingToStart: [4, 5, 6] },
    pose: 'unknown',
    ...DRIVEN,
  },
  { name: 'Ready, posed', frames: 3, selectedFrame: 2 },
  { name: 'Ready, simulated at a gateway', way: { ...REMOTE, isSimulated: true }, ...BAR },
  {
    name: 'Stopped, simulated at a gateway, another drives',
    way: { ...REMOTE, isSimulated: true },
    state: { ...latched('elsewhere', 'sent'), lease: WATCHED },
    ...BAR,
  },
  { name: 'Moving', way: REMOTE, pose: 'moving', ...DRIVEN },
  {
    name: 'Playing from the page',
    state: { ...READY, activity: { kind: 'playing', frameIndex: 1, frameCount: 4 } },
    pose: 'moving',
    frames: 4,
    shows: ['bar', 'live', 'group'],
  },
  { name: 'Running, requested', way: REMOTE, state: running('requested', 2), frames: 3, ...STORED },
  {
    name: 'Running, acknowledged',
    way: REMOTE,
    state: running('acknowledged', 0),
    pose: 'moving',
    frames: 3,
  },
  { name: 'Running, unknown', way: REMOTE, state: running('unknown', 1), frames: 3, ...STORED },
  { name: 'Downloading', state: DOWNLOADING, frames: 21, ...STORED },
  { name: 'Erasing', state: { ...READY, activity: { kind: 'erasing' } }, frames: 2, ...STORED },
  { name: 'Stopped, sending', state: latched('pressed', 'sending'), ...LATCHED },
  { name: 'Stopped, sent', state: latched('pressed', 'sent'), pose: 'moving', frames: 3 },
  { name: 'Stopped, confirmed', state: latched('pressed', 'confirmed'), ...LATCHED },
  { name: 'Stopped, failed', state: latched('pressed', 'failed'), ...LATCHED },
  {
    name: 'Stopped in a first move',
    state: latched('pressed', 'sent', { servos: [3, 5], forMs: 1_200 }),
    ...LATCHED,
  },
  {
    name: 'Stopped in a group that the board alone knows',
    state: latched('pressed', 'sent', { servos: null, forMs: 30_000 }),
    ...LATCHED,
  },
  { name: 'Stopped elsewhere', way: REMOTE, state: latched('elsewhere', 'sent'), ...DRIVEN },
  { name: 'Stopped for the battery', state: latched('battery', 'sent'), ...LATCHED },
  { name: 'Stopped for want of a driver', way: REMOTE, state: latched('unwatched', 'sent'), ...DRIVEN },
  { name: 'Back after a loss', state: latched('reconnected', 'sent'), pose: 'unknown', ...DRIVEN },
  { name: 'Lost with countdown', state: lost('lost', 3_600_000), pose: 'unknown', frames: 3 },
  ...Object.entries(FEEDS).map(([name, feed]): Specimen => ({
    name,
    state: { ...READY, battery: { kind: 'read', batteryMv: feed.volts.at(-1) ?? 0, atMs: 0 } },
    feed,
    ...STORED,
  })),
  { name: 'Battery silent', state: { ...READY, battery: { kind: 'silent', lastMv: null } }, ...STORED },
  { name: 'Broken slot', state: { ...READY, brokenSlots: [0] }, frames: 3, ...STORED },
  { name: 'Sixteen servos', board: 'lsc-16', pose: 'moving', ...DRIVEN },
  ...SERVO_SPECIMENS.map((specimen): Specimen => ({ pose: 'moving', frames: 3, ...specimen })),
  { name: 'Old uHand', board: 'openarm-old', state: NO_BATTERY, frames: 3, ...WITH_MESSAGES },
  { name: 'LeArm', board: 'learm-esp32', state: NO_BATTERY, frames: 2, ...WITH_MESSAGES },
  {
    name: 'Positions read',
    board: 'xarm',
    state: { ...READY, reported: reported([498, 512, 700, 350, 0, -3]) },
    frames: 2,
    ...WITH_MESSAGES,
  },
  {
    name: 'LeArm, question',
    board: 'learm-esp32',
    nickname: 'Shelf arm',
    state: {
      ...NO_BATTERY,
      identity: identityFrom(VERSION_MESSAGES),
      reported: reported([770, 1500, 644, 511, 1255, 1500]),
      version: 1,
      offsets: [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, offset: servo === 2 ? -5 : 0 })),
    },
    frames: 2,
    ...WITH_MESSAGES,
  },
  { name: 'Bus servos', board: 'bus-ctrl', pose: 'moving', frames: 2, ...WITH_MESSAGES },
  {
    name: 'Nicknamed',
    nickname: 'Desk arm',
    state: { ...READY, identity: identityFrom(BATTERY_MESSAGES) },
    ...BAR,
  },
  {
    name: 'Identifying',
    isUnknown: true,
    state: { ...INITIAL_STATE, link: { status: 'identifying' } },
    pose: 'unknown',
    ...WITH_MESSAGES,
  },
  ...Object.entries(UNSURE).map(([name, evidence]): Specimen => ({
    name,
    isUnknown: true,
    state: { ...refused(codeOf(evidence)), identity: identityFrom(evidence), battery: { kind: 'unread' } },
    pose: 'unknown',
    ...BAR,
  })),
  {
    name: 'Stale',
    board: 'lsc-16',
    state: { ...latched('reconnected', 'failed'), link: { status: 'stale', sinceMs: 0 } },
    pose: 'unknown',
    ...DRIVEN,
  },
  ...Object.entries(LEASES).map(([name, lease]): Specimen => ({
    ...{ name, way: REMOTE, state: { ...READY, lease }, pose: 'moving', frames: 2 },
    ...(lease.unattended === null ? DRIVEN : WITH_MESSAGES),
  })),
  {
    name: 'Another drives, stopped',
    way: REMOTE,
    state: { ...latched('elsewhere', 'sent'), lease: WATCHED },
    ...DRIVEN,
  },
  {
    name: 'Another drives, downloading',
    way: REMOTE,
    state: { ...DOWNLOADING, lease: WATCHED, brokenSlots: [5] },
    frames: 21,
    ...WITH_MESSAGES,
  },
  {
    name: 'Downloading several',
    way: REMOTE,
    state: { ...DOWNLOADING_SEVERAL, brokenSlots: [9] },
    frames: 21,
    ...STORED,
  },
  ...LINK_ERROR_CODES.map((code): Specimen => ({
    ...{ name: `Error ${code}`, state: refused(code), pose: 'unknown', ...BAR },
  })),
];
