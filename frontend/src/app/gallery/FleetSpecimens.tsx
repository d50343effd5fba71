// The fleet page in its states: robots in every condition, tasks and events; none yet; and what does not work.

import { useState } from 'react';
import type { FleetChanges } from '#shared/client/http.generated.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import type { FleetApi } from '../../fleet/fleetApi.ts';
import { FleetPage } from '../../fleet/FleetPage.tsx';
import { createFleet, type FleetState } from '../../fleet/fleetStore.ts';
import { drivenRobot, fleetGroup, fleetLibrary, fleetRobot } from '../../fleet/samples.ts';
import type { Exhibit } from './exhibit.ts';

const AT_MS = 1_790_000_000_000;
const SLOTS = [
  { slot: 3, name: 'Wave' },
  { slot: 4, name: 'Bow' },
];

const ROBOTS: FleetChanges['robots'] = [
  fleetRobot('Arm 1', { slots: SLOTS, groups: ['Table 1'], page: 'http://arm-1.local:8300/' }),
  fleetRobot('Arm 2', {
    ...{ slots: SLOTS, groups: ['Table 1'] },
    state: { driver: 'Anna', running: { slot: 3, name: 'Wave' } },
  }),
  fleetRobot('Arm 3', {
    slots: SLOTS,
    groups: ['Table 2'],
    state: { batteryMv: 6100, running: { slot: 4, name: 'Bow' } },
  }),
  fleetRobot('Arm 4', { slots: SLOTS, state: { latch: true, stoppedBy: 'Ben' } }),
  fleetRobot('Arm 5', { state: { link: 'lost', batteryMv: null } }),
  fleetRobot('Arm 6', { presence: 'silent', seenMsAgo: 130_000 }),
  fleetRobot('Arm 7', { presence: 'cloned' }),
  fleetRobot('Hexapod', { board: 'lsc-32', robot: 'Hexapod', state: { driver: 'Carla' } }),
];

const LIBRARY = fleetLibrary([
  fleetGroup('Wave', [1, 2, 3]),
  fleetGroup('Nod', [5]),
  fleetGroup('Turn around', [1, 6], 4),
  fleetGroup('Crawl', [7, 8, 9, 10, 11, 12, 13]),
]);

const UNREAD = { ...LIBRARY, read: () => Promise.reject(new Error('the gateway does not answer')) };

const TASKS: FleetChanges['tasks'] = [
  {
    ...{ id: '1', verb: 'run', names: ['Bow'], by: 'Anna', spreadMs: 3.2 },
    parts: [
      { robot: 'Arm 1', status: 'done', share: null, detail: null },
      { robot: 'Arm 5', status: 'failed', share: null, detail: 'The robot is not connected.' },
    ],
  },
  {
    ...{ id: '2', verb: 'download', names: ['Wave', 'Bow'], by: 'Anna', spreadMs: null },
    parts: [
      { robot: 'Arm 1', status: 'done', share: null, detail: null },
      { robot: 'Arm 2', status: 'busy', share: 0.4, detail: null },
    ],
  },
];

/** The task that is begun by whatever is asked. */
const BEGUN = '9';
const DRIVES = { type: 'lease', lease: 'driving', driver: 'Ben' } as const;
const WAITS = { type: 'lease', lease: 'requested', driver: 'Anna' } as const;

interface Named {
  readonly name: string;
  readonly state: Partial<FleetState>;
  /** The robot that is driven. */
  readonly driven?: string;
  /** The gateway refuses whatever is asked. */
  readonly refuses?: boolean;
}

const FLEET_AT_WORK: Partial<FleetState> = {
  ...{ robots: ROBOTS, tasks: TASKS, selected: new Set(['Arm 1', 'Arm 2', 'Arm 4']) },
  cues: [
    { name: 'Wave', robots: 'Table 1', times: 2, stopsOthers: true },
    { name: 'Bow', robots: '', times: 1, stopsOthers: false },
  ],
  events: [
    { atMs: AT_MS, robot: 'Arm 4', kind: 'stopped', by: 'Ben' },
    { atMs: AT_MS + 60_000, robot: 'Arm 5', kind: 'lost', by: null },
  ],
};

const STATES: readonly Named[] = [
  {
    name: 'Fleet',
    state: FLEET_AT_WORK,
  },
  {
    name: 'Fleet, one not reached',
    state: { robots: ROBOTS, stopping: { count: 8, notReached: ['Arm 6'], problem: null } },
  },
  { name: 'Fleet, one driven', state: { robots: ROBOTS }, driven: 'Arm 1' },
  { name: 'Fleet, one driven by another person', state: { robots: ROBOTS }, driven: 'Arm 2' },
  {
    name: 'Fleet, one that does not resume',
    state: {
      robots: ROBOTS,
      tasks: [
        {
          ...{ id: BEGUN, verb: 'resume', names: [], by: 'Anna', spreadMs: null },
          parts: [
            {
              ...{ robot: 'Arm 4', status: 'failed', share: null },
              detail: 'STOP was pressed after this was requested.',
            },
          ],
        },
      ],
    },
    driven: 'Arm 4',
  },
  { name: 'Fleet, one that is refused', state: { robots: ROBOTS }, driven: 'Arm 4', refuses: true },
  { name: 'Fleet, refused', state: FLEET_AT_WORK, refuses: true },
  { name: 'Fleet, no robots', state: {} },
  { name: 'Fleet, nothing heard yet', state: { site: '', broker: null } },
  {
    name: 'Fleet, broker lost',
    state: { robots: ROBOTS, broker: { status: 'connecting', detail: 'The broker cannot be reached.' } },
  },
];

export const FLEET: readonly Exhibit[] = STATES.map((named) => ({
  name: named.name,
  content: <Shown {...named} />,
}));

function Shown({ state, driven, refuses = false }: Named) {
  const [fleet] = useState(() => {
    const made = createFleet(refuses ? refusing() : answering(), refuses ? UNREAD : LIBRARY, {
      now: () => 0,
      after: () => () => undefined,
    });
    made.store.setState({ site: 'lab', broker: { status: 'connected', detail: '' }, ...state });
    return made;
  });
  return <FleetPage fleet={fleet} mayDrive hasOwnRobot driven={driven ?? null} />;
}

/** Everything is done at once. */
function answering(): FleetApi {
  const task = { id: BEGUN, verb: 'run' as const, names: ['Wave'], by: 'Anna', spreadMs: null };
  const begun = () => Promise.resolve({ ...task, parts: [] });
  return {
    changes: () => new Promise(() => undefined),
    stop: (robots) =>
      Promise.resolve({ reached: [...(robots ?? ROBOTS.map(({ id }) => id))], notReached: [] }),
    ...{ run: begun, download: begun, resume: begun, retry: begun },
    drive: (robot, listener) => drivenRobot(robot === 'Arm 2' ? WAITS : DRIVES, listener),
    group: () => Promise.resolve(),
    setCues: () => Promise.resolve(),
  };
}

function refusing(): FleetApi {
  const refused = () => Promise.reject(new GatewayProblem('conflict', 'The gateway is being updated.'));
  return {
    ...answering(),
    ...{
      run: refused,
      download: refused,
      resume: refused,
      retry: refused,
      group: refused,
      setCues: refused,
    },
  };
}
