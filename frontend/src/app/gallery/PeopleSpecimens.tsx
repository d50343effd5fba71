// Connecting, pairing, the stop-only page and an owner's view of people, in their states.

import type { ReactNode } from 'react';
import { NameCard, PairCard, StopFace, type StopOutcome } from '../../features/people/EntryPage.tsx';
import { OwnView, PeopleView } from '../../features/people/PeopleView.tsx';
import { PeopleError, type PeopleState } from '../../features/people/people.ts';
import type { AuditEntry } from '#shared/client/http.generated.ts';
import type { ActsState } from '../../features/people/acts.ts';
import { ActsView } from '../../features/people/ActsView.tsx';
import type { Exhibit } from './exhibit.ts';
import type { Way } from '../../robot/device.ts';
import type { ConnectState } from '../../robot/connector.ts';
import type { Actions } from '../../features/connect/cables.ts';
import { Ways } from '../../features/connect/ConnectWays.tsx';

/** Not a real QR code. */
const PICTURE =
  'data:image/svg+xml,%3Csvg xmlns=%22http://www.w3.org/2000/svg%22 viewBox=%220 0 7 7%22%3E%3Cpath d=%22M1 1h2v2H1zM4 1h2v2H4zM1 4h2v2H1zM5 5h1v1H5z%22/%3E%3C/svg%3E';
const AT_MS = 1_790_000_000_000;

const EMPTY: PeopleState = {
  me: { mode: 'lan', overheard: true, you: { id: 'anna', name: 'Anna', role: 'owner' }, pages: ['robot'] },
  people: [
    person('anna', 'Anna', 'owner', true),
    person('ben', 'Ben, whose name is rather long for one row', 'driver', true),
    person('dora', 'Cleo', 'driver', true),
    person('cleo', 'iPhone', 'viewer', false),
  ],
  invitation: null,
  shown: null,
};

const CASES: readonly { readonly name: string; readonly state: PeopleState }[] = [
  { name: 'People', state: EMPTY },
  {
    name: 'People, invitation open',
    state: {
      ...EMPTY,
      invitation: {
        ...{ id: 'one', role: 'driver', code: '12345678', picture: PICTURE },
        ...{ link: 'http://192.168.1.5:8300/#pair=not-a-real-one', expiresInMs: 120_000, untilMs: 120_000 },
      },
    },
  },
  {
    name: 'People, codes spent',
    state: {
      ...EMPTY,
      invitation: {
        ...{ id: 'one', role: 'viewer', code: null, picture: PICTURE },
        ...{ link: 'http://192.168.1.5:8300/#pair=not-a-real-one', expiresInMs: 120_000, untilMs: 120_000 },
      },
    },
  },
  {
    name: 'People, token shown',
    state: {
      ...EMPTY,
      people: [
        ...EMPTY.people,
        token('nightly', 'Nightly test', 12 * 86_400_000),
        token('fair', 'Dance of the fair', 0),
      ],
      shown: { kind: 'token', name: 'Script', token: 'abc123.not-a-real-one' },
    },
  },
  {
    name: 'People, stop-only link shown',
    state: {
      ...EMPTY,
      people: [
        ...EMPTY.people,
        { ...person('link', 'On the robot', 'stopper', false), kind: 'stopLink', lastSeenMs: null },
      ],
      shown: {
        kind: 'stopLink',
        name: 'On the robot',
        link: 'http://192.168.1.5:8300/#stop=x',
        picture: PICTURE,
      },
    },
  },
];

function person(id: string, name: string, role: PeopleState['people'][number]['role'], here: boolean) {
  return {
    id,
    kind: 'device',
    name,
    role,
    here,
    drives: id === 'ben',
    unattendedSlot: null,
    pairedAtMs: AT_MS,
    lastSeenMs: AT_MS,
    expiresInMs: null,
  } as const;
}

function token(id: string, name: string, expiresInMs: number): PeopleState['people'][number] {
  return { ...person(id, name, 'driver', false), kind: 'token', expiresInMs };
}

const PROBLEMS: readonly (PeopleError | null)[] = [
  null,
  new PeopleError('failed', ''),
  new PeopleError('locked', ''),
];
const OUTCOMES: readonly StopOutcome[] = ['idle', 'sending', 'sent', new PeopleError('notPaired', '')];

const GUEST: PeopleState['me'] = {
  mode: 'lan',
  overheard: true,
  you: { id: 'ben', name: 'Bert', role: 'driver' },
  pages: ['robot'],
};

const nothing = (): void => undefined;
const WISHES = {
  ...{ sayName: nothing, invite: nothing, endInvitation: nothing, change: nothing, revoke: nothing },
  ...{ makeToken: nothing, makeStopLink: nothing, closeShown: nothing },
};

const inDialog = (name: string, content: ReactNode): Exhibit => ({ name, content, isInDialog: true });

const HAPPENED: readonly AuditEntry[] = [
  happened(9, 'stopped', 'Ben, whose name is rather long for one row'),
  happened(8, 'stopped', null, { about: 'silence' }),
  happened(7, 'downloaded', 'Anna', { about: '5, 6' }),
  happened(6, 'moved', 'Dance', { count: 212, untilMs: AT_MS + 90_000 }),
  happened(5, 'roleChanged', 'Anna', { whom: 'iPhone', about: 'driver' }),
  happened(4, 'pairRefused', null, { count: 4, untilMs: AT_MS + 30_000 }),
  happened(3, 'tokenExpired', null, { whom: 'Dance of the fair' }),
];

function happened(
  id: number,
  act: AuditEntry['act'],
  who: string | null,
  more: Partial<AuditEntry> = {},
): AuditEntry {
  return { id, act, who, whom: '', about: '', atMs: AT_MS, untilMs: AT_MS, count: 1, ...more };
}

const ACTS: ActsState = {
  entries: HAPPENED,
  hasOlder: true,
  names: ['Anna', 'Ben, whose name is rather long for one row', 'Dance'],
  problem: null,
  filter: { act: '', who: '' },
};

const ACT_CASES: readonly { readonly name: string; readonly state: ActsState }[] = [
  { name: 'What happened', state: ACTS },
  { name: 'What happened, nothing', state: { ...ACTS, entries: [], hasOlder: false } },
  {
    name: 'What happened, not stored',
    state: { ...ACTS, hasOlder: false, problem: 'The disk of the data folder is full.' },
  },
  {
    name: 'What happened, none found',
    state: { ...ACTS, entries: [], hasOlder: false, filter: { act: 'erased', who: 'Dance' } },
  },
];

export const PEOPLE: readonly Exhibit[] = [
  ...PROBLEMS.map((problem, index) =>
    inDialog(
      `Pair card ${index + 1}`,
      <PairCard problem={problem} overheard suggested="iPhone" onPair={nothing} />,
    ),
  ),
  inDialog('Name card', <NameCard suggested="iPhone" problem={null} onName={nothing} />),
  inDialog(
    'Name card, not heard',
    <NameCard suggested="iPhone" problem={new PeopleError('unreachable', '')} onName={nothing} />,
  ),
  inDialog('Your name', <OwnView me={GUEST} onRename={nothing} />),
  ...OUTCOMES.map((outcome, index) =>
    inDialog(`Stop only ${index + 1}`, <StopFace outcome={outcome} onPress={nothing} />),
  ),
  ...CASES.map(({ name, state }) =>
    inDialog(
      name,
      <PeopleView
        state={state}
        wishes={WISHES}
        candidates={[{ id: 'dora', name: 'Cleo' }]}
        onHandOver={nothing}
        now={() => 0}
      />,
    ),
  ),
  ...ACT_CASES.map(({ name, state }) =>
    inDialog(name, <ActsView state={state} onFilter={nothing} onOlder={nothing} onExport={nothing} />),
  ),
];

const BASE: ConnectState = {
  board: 'doc',
  reconnects: true,
  serialObstacle: null,
  granted: [],
  hid: { obstacle: null, granted: [] },
  bluetooth: { obstacle: null, granted: [] },
  openDevice: null,
  gateway: 'absent',
  gatewayPorts: [],
  body: null,
};

/** Ports that are only compared, never opened. */
const PORT = Object.create(null) as SerialPort;
const OTHER_PORT = Object.create(null) as SerialPort;

const WAYS: readonly {
  readonly name: string;
  readonly state: ConnectState;
  readonly current: Way['kind'] | null;
  /** The current way leads nowhere. */
  readonly isClosed?: boolean;
}[] = [
  {
    name: 'Connect, no gateway',
    state: BASE,
    current: 'simulated',
  },
  {
    name: 'Connect, a port is open',
    current: 'webSerial',
    state: {
      ...BASE,
      openDevice: PORT,
      granted: [
        { port: PORT, label: 'CH340 USB serial adapter' },
        { port: OTHER_PORT, label: 'FT232 USB serial adapter' },
      ],
    },
  },
  {
    name: 'Connect, gateway with ports',
    current: 'gateway',
    state: {
      ...BASE,
      gateway: { device: '/dev/ttyUSB0', isSimulated: false },
      gatewayPorts: [
        { device: '/dev/ttyUSB0', description: 'USB Serial', inUse: true },
        { device: '/dev/ttyACM1', description: 'Arduino', inUse: false },
      ],
    },
  },
  {
    name: 'Connect, gateway without a port',
    current: 'gateway',
    isClosed: true,
    state: { ...BASE, gateway: { device: null, isSimulated: false } },
  },
  {
    name: 'Connect, insecure address',
    current: null,
    state: {
      ...BASE,
      serialObstacle: 'insecureAddress',
      hid: { obstacle: 'insecureAddress', granted: [] },
      bluetooth: { obstacle: 'insecureAddress', granted: [] },
      gateway: { device: null, isSimulated: false },
    },
  },
  {
    name: 'Connect, browser without serial ports',
    current: null,
    state: {
      ...BASE,
      serialObstacle: 'unsupported',
      hid: { obstacle: 'unsupported', granted: [] },
      bluetooth: { obstacle: 'unsupported', granted: [] },
      gateway: 'looking',
    },
  },
];

const doNothing = (): void => undefined;
const later = (): Promise<void> => Promise.resolve();
const ACTIONS: Actions = {
  look: later,
  simulate: later,
  setReconnects: doNothing,
  setBody: doNothing,
  useGateway: doNothing,
  useGatewayPort: later,
  useSerialPort: later,
  chooseSerialPort: later,
  findRate: () => Promise.resolve(null),
  useBoard: later,
  chooseBoard: later,
  useModule: later,
  chooseModule: later,
  disconnect: doNothing,
};

export const CONNECT: readonly Exhibit[] = WAYS.map(({ name, state, current, isClosed = false }) => ({
  name,
  isInDialog: true,
  content: (
    <Ways
      state={state}
      current={current}
      body="arm"
      isOpen={current !== null && !isClosed}
      isReady={current !== null && !isClosed}
      actions={ACTIONS}
      onChoose={doNothing}
      onLook={doNothing}
    />
  ),
}));
