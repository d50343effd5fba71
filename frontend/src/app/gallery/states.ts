// Snapshots, positions, battery readings and packets for the states of the gallery, as plain values.

import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import type { BatteryKind } from '#shared/profile/robot.ts';
import type { Evidence } from '#shared/robot/identity.ts';
import type { Lease, Unattended } from '#shared/robot/lease.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { ServoMotion, SessionState, Traffic } from '#shared/robot/state.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import type { Way } from '../../robot/device.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import type { Command } from '#shared/codec/commands.ts';
import { fromHex } from '#shared/codec/packet.ts';
import type { Report } from '#shared/codec/reports.ts';

/** The kind of battery, and its readings, one every five seconds. */
export interface BatteryFeed {
  readonly kind: BatteryKind;
  readonly volts: readonly number[];
}

export const SIMULATED: Way = { kind: 'simulated', label: 'Simulated board', isSimulated: true };
export const USB: Way = { kind: 'webSerial', label: 'CH340 USB serial adapter', isSimulated: false };
export const REMOTE: Way = { kind: 'gateway', label: '/dev/ttyUSB0', isSimulated: false };

export const READY: SessionState = {
  ...INITIAL_STATE,
  link: { status: 'ready' },
  battery: { kind: 'read', batteryMv: 7500, atMs: 0 },
};

/** Of a board without a command to read it. */
export const NO_BATTERY: SessionState = { ...READY, battery: { kind: 'unread' } };

export const LEASE: Lease = {
  ...{ driver: 'Anna', drives: true, requestedBy: null, hasRequested: false, grantedInMs: null },
  ...{
    you: 'Anna',
    mayDrive: true,
    mayTake: false,
    grantedBy: null,
    candidates: [],
    others: 3,
    unattended: null,
  },
};

export const WATCHED: Lease = { ...LEASE, you: 'Cleo', drives: false };

const ALONE: Unattended = { slot: 5, times: 20, by: 'Anna', endsInMs: 245_000, isMove: false };

const PRESENT: Lease['candidates'] = [
  { id: 'bert', name: 'Bert' },
  { id: 'cleo', name: 'Cleo' },
];

/** The lease as each of the people sees it. */
export const LEASES: Readonly<Record<string, Lease>> = {
  'You drive': LEASE,
  'You drive, requested': { ...LEASE, requestedBy: 'Bert', grantedInMs: 5000 },
  'You drive, others may': { ...LEASE, candidates: PRESENT },
  'You drive, handed over': { ...LEASE, you: 'Bert', driver: 'Bert', grantedBy: 'Anna', candidates: PRESENT },
  'Another drives': WATCHED,
  'Another drives, requested': { ...WATCHED, requestedBy: 'Bert', hasRequested: true, grantedInMs: 5000 },
  'Another drives, yours to take': { ...WATCHED, mayTake: true, candidates: PRESENT },
  'Another window drives, yours to take': { ...WATCHED, driver: 'Cleo', mayTake: true },
  'No driver': { ...WATCHED, driver: null },
  'You drive, it may go on': { ...LEASE, unattended: ALONE },
  'It continues unattended': { ...WATCHED, driver: null, others: 0, unattended: ALONE },
  'Looking on only': { ...WATCHED, driver: null, mayDrive: false },
};

export const lost = (code: LinkError['code'], retryAtMs: number | null): SessionState => ({
  ...READY,
  link: { status: 'lost', error: new LinkError(code, 'detail of the failure'), retryAtMs },
});

export const refused = (code: LinkError['code']): SessionState => ({
  ...READY,
  link: { status: 'refused', error: new LinkError(code, 'detail of the failure') },
});

export const running = (truth: 'requested' | 'acknowledged' | 'unknown', times: number): SessionState => ({
  ...READY,
  activity: { kind: 'running', slot: 5, times, sinceMs: 0, truth },
});

const SILENT_TO_ALL: readonly Evidence[] = [
  { kind: 'silent', question: 'readBattery' },
  { kind: 'silent', question: 'readVersion' },
];
export const BATTERY_MESSAGES: readonly Evidence[] = [
  { kind: 'answered', question: 'readBattery', report: { kind: 'battery', batteryMv: 7500 } },
  { kind: 'silent', question: 'readPositions' },
];
const POSITION_MESSAGES: readonly Evidence[] = [
  { kind: 'answered', question: 'readBattery', report: { kind: 'battery', batteryMv: 11_400 } },
  {
    kind: 'answered',
    question: 'readPositions',
    report: { kind: 'positions', positions: [{ servo: 1, position: 498 }] },
  },
];
export const VERSION_MESSAGES: readonly Evidence[] = [
  { kind: 'silent', question: 'readBattery' },
  { kind: 'answered', question: 'readVersion', report: { kind: 'version', unit: 'us', version: 1 } },
];

export const UNSURE: Readonly<Record<string, readonly Evidence[]>> = {
  'Which board, silent': SILENT_TO_ALL,
  'Which board, LSC': BATTERY_MESSAGES,
  'Which board, bus servos': POSITION_MESSAGES,
  'Which board, LeArm': VERSION_MESSAGES,
  'Which board, noise': [...SILENT_TO_ALL, { kind: 'noise', byteCount: 118 }],
  'Which board, echo': [...SILENT_TO_ALL, { kind: 'echoed' }],
};

export const reported = (positions: readonly number[]): SessionState['reported'] =>
  Object.fromEntries(positions.map((position, index) => [index + 1, { position, atMs: 0 }]));

export const codeOf = (evidence: readonly Evidence[]): LinkError['code'] =>
  evidence.some(({ kind }) => kind === 'echoed') ? 'echo' : 'boardUnknown';

export const DOWNLOADING: SessionState = {
  ...READY,
  activity: {
    kind: 'downloading',
    slot: 5,
    slots: [5],
    groupsStored: 0,
    framesStored: 9,
    frameCount: 21,
    bytesSent: 264,
    bytesTotal: 616,
    remainingMs: 4200,
  },
};

export const DOWNLOADING_SEVERAL: SessionState = {
  ...READY,
  activity: {
    kind: 'downloading',
    slot: 9,
    slots: [5, 9, 12],
    groupsStored: 1,
    framesStored: 29,
    frameCount: 58,
    bytesSent: 812,
    bytesTotal: 1624,
    remainingMs: 11_400,
  },
};

/** Half an hour of a pack in use. */
const sinking = (fromMv: number, toMv: number): readonly number[] =>
  Array.from({ length: 360 }, (_, index) => {
    const share = index / 359;
    return Math.round(fromMv + (toMv - fromMv) * share ** 1.5 + 25 * Math.sin(index * 1.7));
  });

export const FEEDS: Readonly<Record<string, BatteryFeed>> = {
  'Battery, 2S': { kind: '2s', volts: sinking(8280, 7520) },
  'Battery, 3S': { kind: '3s', volts: sinking(9780, 9700) },
  'Battery low': { kind: '2s', volts: sinking(7600, 6880) },
  'Battery empty': { kind: '2s', volts: sinking(7200, 6480) },
  'Battery, weak adapter': { kind: 'adapter', volts: sinking(7500, 6350) },
  'Battery, zero': { kind: '2s', volts: [0, 0, 0] },
  'Battery, saturated': { kind: '3s', volts: [9900, 9900, 9900] },
};

export type Pose = 'unknown' | 'still' | 'moving';

/** Positions of a board's servos, spread over the range so that every row differs. */
export function motionsOf(board: FamilyId, pose: Pose): Readonly<Record<number, ServoMotion>> {
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

const POSE = [1200, 1500, 1950, 2050, 1150, 1500].map((position, index) => ({ servo: index + 1, position }));

const COMMANDS: readonly Command[] = [
  { kind: 'readBattery' },
  { kind: 'move', durationMs: 1000, targets: POSE },
  { kind: 'download', slot: 5, frameCount: 3, frameIndex: 0, frame: { durationMs: 800, targets: POSE } },
  { kind: 'run', slot: 5, times: 2 },
  { kind: 'stop' },
  { kind: 'erase' },
];

const REPORTS: readonly { readonly hex: string; readonly report: Report }[] = [
  { hex: '55 55 04 0F 4C 1D', report: { kind: 'battery', batteryMv: 7500 } },
  { hex: '55 55 02 19', report: { kind: 'frameStored' } },
  { hex: '55 55 02 06', report: { kind: 'runAccepted' } },
  { hex: '55 55 02 07', report: { kind: 'runFinished', slot: null } },
  { hex: '55 55 02 08', report: { kind: 'erased' } },
];

export const SAMPLE_TRAFFIC: readonly Traffic[] = [
  ...COMMANDS.map((command, index): Traffic => ({
    atMs: 1000 + index * 400,
    direction: 'out',
    bytes: encodeCommand(command, FAMILIES.doc),
    command,
  })),
  ...REPORTS.map(({ hex, report }, index): Traffic => ({
    atMs: 4000 + index * 90,
    direction: 'in',
    bytes: fromHex(hex),
    report,
  })),
  { atMs: 5200, direction: 'in', bytes: fromHex('41 54 0D 0A'), noise: 'garbage' },
  { atMs: 5300, direction: 'in', bytes: fromHex('55 55 04 0F 4C'), noise: 'truncated' },
];
