// Every state of the page as plain values: what the session says, where the servos are, what is written and selected.

import { LINK_ERROR_CODES, LinkError } from '#shared/session/linkError.ts';
import { FAMILIES, type FamilyId } from '#shared/protocol/families.ts';
import type { BatteryKind } from '#shared/actions/robot/robot.ts';
import type { Lease, Unattended } from '#shared/session/lease.ts';
import type { ServoMotion, SessionState } from '#shared/session/state.ts';
import type { Way } from '../stores/device.ts';
import { identityFrom, type Evidence } from '#shared/session/identity.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import { SERVO_SPECIMENS, type ServoSpecimen } from './servoSpecimens.ts';

export interface Specimen {
  /** Another robot than the usual one of the board. */
  readonly robot?: ServoSpecimen;
  readonly name: string;
  readonly board?: FamilyId;
  /** Nobody has said which board it is. */
  readonly isUnknown?: boolean;
  readonly nickname?: string;
  readonly groupName?: string;
  readonly way: Way | null;
  readonly state: SessionState;
  readonly pose: 'unknown' | 'still' | 'moving';
  readonly frames: number;
  readonly selectedFrame?: number;
  readonly feed?: BatteryFeed;
  /** Where the board's servos were last sent, at an earlier visit. */
  readonly lastPositions?: Readonly<Record<number, number>>;
}

/** What feeds the robot, and what was read until now, one reading every five seconds. */
export interface BatteryFeed {
  readonly kind: BatteryKind;
  readonly volts: readonly number[];
}

const SIMULATED: Way = { kind: 'simulated', label: 'Simulated board', isSimulated: true };
const USB: Way = { kind: 'webSerial', label: 'USB 1A86:7523', isSimulated: false };
const REMOTE: Way = { kind: 'gateway', label: '/dev/ttyUSB0', isSimulated: false };

const READY: SessionState = {
  ...INITIAL_STATE,
  link: { status: 'ready' },
  battery: { kind: 'read', batteryMv: 7500, atMs: 0 },
};

/** No reading ever comes where the board has no command for it. */
const NO_BATTERY: SessionState = { ...READY, battery: { kind: 'unread' } };

export const LEASE: Lease = {
  ...{ driver: 'Anna', drives: true, asker: null, asks: false, answerInMs: null },
  ...{ mayDrive: true, mayTake: false, others: 3, unattended: null },
};

const WATCHED: Lease = { ...LEASE, drives: false };

const ALONE: Unattended = { slot: 5, times: 20, by: 'Anna', endsInMs: 245_000 };

/** Whose turn it is, as each of the people there sees it. */
const TURNS: Readonly<Record<string, Lease>> = {
  'You drive': LEASE,
  'You drive, asked': { ...LEASE, asker: 'Bert', answerInMs: 5000 },
  'Another drives': WATCHED,
  'Another drives, asked': { ...WATCHED, asker: 'Bert', asks: true, answerInMs: 5000 },
  'Another drives, yours to take': { ...WATCHED, driver: 'This computer', mayTake: true },
  'Nobody drives': { ...WATCHED, driver: null },
  'You drive, it may go on': { ...LEASE, unattended: ALONE },
  'It goes on alone': { ...WATCHED, driver: null, others: 0, unattended: ALONE },
  'Looking on only': { ...WATCHED, driver: null, mayDrive: false },
};

const lost = (code: LinkError['code'], retryAtMs: number | null): SessionState => ({
  ...READY,
  link: { status: 'lost', error: new LinkError(code, 'detail of the failure'), retryAtMs },
});

const refused = (code: LinkError['code']): SessionState => ({
  ...READY,
  link: { status: 'refused', error: new LinkError(code, 'detail of the failure') },
});

const running = (truth: 'requested' | 'acknowledged' | 'unknown', times: number): SessionState => ({
  ...READY,
  activity: { kind: 'running', slot: 5, times, sinceMs: 0, truth },
});

const SILENT_TO_ALL: readonly Evidence[] = [
  { kind: 'silent', question: 'readBattery' },
  { kind: 'silent', question: 'readVersion' },
];
const BATTERY_TOLD: readonly Evidence[] = [
  { kind: 'answered', question: 'readBattery', report: { kind: 'battery', batteryMv: 7500 } },
  { kind: 'silent', question: 'readPositions' },
];
const POSITIONS_TOLD: readonly Evidence[] = [
  { kind: 'answered', question: 'readBattery', report: { kind: 'battery', batteryMv: 11_400 } },
  {
    kind: 'answered',
    question: 'readPositions',
    report: { kind: 'positions', positions: [{ servo: 1, position: 498 }] },
  },
];
const VERSION_TOLD: readonly Evidence[] = [
  { kind: 'silent', question: 'readBattery' },
  { kind: 'answered', question: 'readVersion', report: { kind: 'version', unit: 'us', version: 1 } },
];

const UNSURE: Readonly<Record<string, readonly Evidence[]>> = {
  'Which board, silent': SILENT_TO_ALL,
  'Which board, LSC': BATTERY_TOLD,
  'Which board, bus servos': POSITIONS_TOLD,
  'Which board, LeArm': VERSION_TOLD,
  'Which board, noise': [...SILENT_TO_ALL, { kind: 'noise', byteCount: 118 }],
  'Which board, echo': [...SILENT_TO_ALL, { kind: 'echoed' }],
};

const reported = (positions: readonly number[]): SessionState['reported'] =>
  Object.fromEntries(positions.map((position, index) => [index + 1, { position, atMs: 0 }]));

const codeOf = (evidence: readonly Evidence[]): LinkError['code'] =>
  evidence.some(({ kind }) => kind === 'echoed') ? 'echo' : 'boardUnknown';

const DOWNLOADING: SessionState = {
  ...READY,
  activity: {
    kind: 'downloading',
    slot: 5,
    framesStored: 9,
    frameCount: 21,
    bytesSent: 264,
    bytesTotal: 616,
    remainingMs: 4200,
  },
};

/** Half an hour of a pack that is used. */
const sinking = (fromMv: number, toMv: number): readonly number[] =>
  Array.from({ length: 360 }, (_, index) => {
    const share = index / 359;
    return Math.round(fromMv + (toMv - fromMv) * share ** 1.5 + 25 * Math.sin(index * 1.7));
  });

const FEEDS: Readonly<Record<string, BatteryFeed>> = {
  'Battery, 2S': { kind: '2s', volts: sinking(8280, 7520) },
  'Battery, 3S': { kind: '3s', volts: sinking(9780, 9700) },
  'Battery low': { kind: '2s', volts: sinking(7600, 6880) },
  'Battery empty': { kind: '2s', volts: sinking(7200, 6480) },
  'Battery, weak adapter': { kind: 'adapter', volts: sinking(7500, 6350) },
  'Battery, zero': { kind: '2s', volts: [0, 0, 0] },
  'Battery, saturated': { kind: '3s', volts: [9900, 9900, 9900] },
};

export const SPECIMENS: readonly Specimen[] = [
  { name: 'Disconnected', way: null, state: INITIAL_STATE, pose: 'unknown', frames: 0 },
  {
    name: 'Opening',
    way: USB,
    state: { ...INITIAL_STATE, link: { status: 'opening' } },
    pose: 'unknown',
    frames: 0,
  },
  {
    name: 'Ready, nothing known',
    way: SIMULATED,
    state: { ...READY, battery: { kind: 'unread' } },
    pose: 'unknown',
    frames: 0,
  },
  {
    name: 'Ready, last pose known',
    way: USB,
    state: READY,
    pose: 'unknown',
    frames: 0,
    lastPositions: { 1: 1450, 2: 1500, 3: 1950, 4: 2050, 5: 1150, 6: 1700 },
  },
  {
    name: 'Starting one after another',
    way: USB,
    state: { ...READY, waitingToStart: [4, 5, 6] },
    pose: 'unknown',
    frames: 0,
  },
  { name: 'Ready, posed', way: USB, state: READY, pose: 'still', frames: 3, selectedFrame: 2 },
  { name: 'Moving', way: REMOTE, state: READY, pose: 'moving', frames: 7 },
  {
    name: 'Playing from the page',
    way: USB,
    state: { ...READY, activity: { kind: 'playing', frameIndex: 1, frameCount: 4 } },
    pose: 'moving',
    frames: 4,
  },
  { name: 'Running, requested', way: REMOTE, state: running('requested', 2), pose: 'still', frames: 3 },
  {
    name: 'Running, acknowledged',
    way: REMOTE,
    state: running('acknowledged', 0),
    pose: 'moving',
    frames: 3,
  },
  { name: 'Running, unknown', way: REMOTE, state: running('unknown', 1), pose: 'still', frames: 3 },
  { name: 'Downloading', way: USB, state: DOWNLOADING, pose: 'still', frames: 21 },
  { name: 'Erasing', way: USB, state: { ...READY, activity: { kind: 'erasing' } }, pose: 'still', frames: 2 },
  ...(['sending', 'sent', 'confirmed', 'failed'] as const).map((stop): Specimen => ({
    name: `Stopped, ${stop}`,
    way: USB,
    state: { ...READY, latch: { reason: 'pressed', stop, unheld: [] } },
    pose: 'moving',
    frames: 3,
  })),
  {
    name: 'Stopped in a first move',
    way: USB,
    state: { ...READY, latch: { reason: 'pressed', stop: 'sent', unheld: [3, 5] } },
    pose: 'moving',
    frames: 3,
  },
  {
    name: 'Stopped elsewhere',
    way: REMOTE,
    state: { ...READY, latch: { reason: 'elsewhere', stop: 'sent', unheld: [] } },
    pose: 'still',
    frames: 3,
  },
  {
    name: 'Stopped for want of a driver',
    way: REMOTE,
    state: { ...READY, latch: { reason: 'unwatched', stop: 'sent', unheld: [] } },
    pose: 'still',
    frames: 3,
  },
  {
    name: 'Back after a loss',
    way: USB,
    state: { ...READY, latch: { reason: 'reconnected', stop: 'sent', unheld: [] } },
    pose: 'unknown',
    frames: 3,
  },
  { name: 'Lost with countdown', way: USB, state: lost('lost', 3_600_000), pose: 'unknown', frames: 3 },
  ...Object.entries(FEEDS).map(([name, feed]): Specimen => ({
    name,
    way: USB,
    state: { ...READY, battery: { kind: 'read', batteryMv: feed.volts.at(-1) ?? 0, atMs: 0 } },
    pose: 'still',
    frames: 1,
    feed,
  })),
  {
    name: 'Battery silent',
    way: USB,
    state: { ...READY, battery: { kind: 'silent', lastMv: null } },
    pose: 'still',
    frames: 1,
  },
  { name: 'Broken slot', way: USB, state: { ...READY, brokenSlots: [0] }, pose: 'still', frames: 3 },
  { name: 'Stored slot', way: USB, state: { ...READY, storedSlots: [0] }, pose: 'still', frames: 3 },
  { name: 'Sixteen servos', board: 'lsc-16', way: USB, state: READY, pose: 'moving', frames: 2 },
  ...SERVO_SPECIMENS.map((specimen): Specimen => ({
    ...{ way: USB, state: READY, pose: 'moving', frames: 3 },
    ...specimen,
  })),
  { name: 'Old uHand', board: 'openarm-old', way: USB, state: NO_BATTERY, pose: 'still', frames: 3 },
  { name: 'LeArm', board: 'learm-esp32', way: USB, state: NO_BATTERY, pose: 'still', frames: 2 },
  {
    name: 'Positions read',
    board: 'xarm',
    way: USB,
    state: { ...READY, reported: reported([498, 512, 700, 350, 0, -3]) },
    pose: 'still',
    frames: 2,
  },
  {
    name: 'LeArm, asked',
    board: 'learm-esp32',
    way: USB,
    nickname: 'Shelf arm',
    state: {
      ...NO_BATTERY,
      identity: identityFrom(VERSION_TOLD),
      reported: reported([770, 1500, 644, 511, 1255, 1500]),
      version: 1,
      offsets: [1, 2, 3, 4, 5, 6].map((servo) => ({ servo, offset: servo === 2 ? -5 : 0 })),
    },
    pose: 'still',
    frames: 2,
  },
  { name: 'Bus servos', board: 'bus-ctrl', way: USB, state: READY, pose: 'moving', frames: 2 },
  {
    name: 'Nicknamed',
    way: USB,
    nickname: 'Desk arm',
    state: { ...READY, identity: identityFrom(BATTERY_TOLD) },
    pose: 'still',
    frames: 3,
  },
  {
    name: 'Identifying',
    way: USB,
    isUnknown: true,
    state: { ...INITIAL_STATE, link: { status: 'identifying' } },
    pose: 'unknown',
    frames: 0,
  },
  ...Object.entries(UNSURE).map(([name, evidence]): Specimen => ({
    name,
    way: USB,
    isUnknown: true,
    state: { ...refused(codeOf(evidence)), identity: identityFrom(evidence), battery: { kind: 'unread' } },
    pose: 'unknown',
    frames: 0,
  })),
  {
    name: 'Stale',
    way: USB,
    board: 'lsc-16',
    state: {
      ...READY,
      link: { status: 'stale', sinceMs: 0 },
      latch: { reason: 'reconnected', stop: 'failed', unheld: [] },
    },
    pose: 'unknown',
    frames: 2,
  },
  ...Object.entries(TURNS).map(([name, lease]): Specimen => ({
    name,
    way: REMOTE,
    state: { ...READY, lease },
    pose: 'moving',
    frames: 2,
  })),
  {
    name: 'Another drives, stopped',
    way: REMOTE,
    state: { ...READY, lease: WATCHED, latch: { reason: 'elsewhere', stop: 'sent', unheld: [] } },
    pose: 'still',
    frames: 2,
  },
  {
    name: 'Another drives, downloading',
    way: REMOTE,
    state: { ...DOWNLOADING, lease: WATCHED, brokenSlots: [5] },
    pose: 'still',
    frames: 21,
  },
  ...LINK_ERROR_CODES.map((code): Specimen => ({
    name: `Error ${code}`,
    way: USB,
    state: refused(code),
    pose: 'unknown',
    frames: 0,
  })),
];

/** Positions of the specimen's servos, spread over the range so that every row differs. */
export function motionsOf({
  pose,
  board = 'doc',
}: Pick<Specimen, 'pose' | 'board'>): Readonly<Record<number, ServoMotion>> {
  if (pose === 'unknown') return {};
  const { position, usualServoCount } = FAMILIES[board];
  const at = (share: number): number => Math.round(position.min + share * (position.max - position.min));
  return Object.fromEntries(
    Array.from({ length: usualServoCount }, (_, index) => {
      const target = at(POSED[index % POSED.length] ?? 0.5);
      const estimated = pose === 'still' ? target : at(STARTED[index % STARTED.length] ?? 0.5);
      return [index + 1, { target, estimated }];
    }),
  );
}

const POSED = [0.3, 0.5, 0.72, 0.8, 0.3, 0.6];
const STARTED = [0.45, 0.4, 0.6, 0.65, 0.42, 0.5];
