// A class of eight robots for the picture of the fleet page, as a gateway would answer: one is stopped, one has a low battery, one runs a
// group. No broker and no robot has a part in it.

/** @typedef {import('../shared/src/client/http.generated.ts').FleetRobot} FleetRobot */
/** @typedef {NonNullable<FleetRobot['state']>} State */
/** @typedef {import('@playwright/test').Page} Page */

const SLOTS = [
  { slot: 21, name: 'Wave' },
  { slot: 22, name: 'Pick and place' },
];

/** @param {number} number @param {Partial<State>} [state] @param {Partial<FleetRobot>} [rest] @returns {FleetRobot} */
const arm = (number, state = {}, rest = {}) => ({
  ...{ id: `arm-${number}`, name: `arm-${number}`, robot: 'Arm', board: 'lsc-6', version: '0.1.0', page: '' },
  ...{ limits: [], lowBatteryMv: 6800, slots: SLOTS, groups: [number < 5 ? 'Table 1' : 'Table 2'] },
  ...{ presence: 'present', seenMsAgo: null },
  state: {
    ...{ link: 'ready', latch: false, stoppedBy: null, driver: null, running: null },
    batteryMv: 7620 - 37 * number,
    ...state,
  },
  ...rest,
});

const SPIDER = { robot: 'Hexapod', board: 'lsc-32', name: 'spider-1', lowBatteryMv: 6900 };

/** @type {import('../shared/src/client/http.generated.ts').FleetChanges} */
const FLEET = {
  ...{ revision: 1, isWhole: true, site: 'lab', broker: { status: 'connected', detail: '' } },
  ...{ removed: [], tasks: [], events: [] },
  cues: [{ name: 'Wave', robots: 'Table 1', times: 2, stopsOthers: true }],
  robots: [
    arm(1),
    arm(2, { driver: 'anna', running: { slot: 21, name: 'Wave' } }),
    arm(3, { batteryMv: 6610 }),
    arm(4),
    arm(5, { latch: true, stoppedBy: 'Ben' }),
    arm(6),
    arm(7),
    arm(8, {}, SPIDER),
  ],
};

const ME = {
  ...{ mode: 'local', overheard: false, pages: ['fleet'] },
  you: { id: 'local', name: 'This computer', role: 'owner' },
};

/** Has the page hear these answers. @param {Page} page */
export async function answerForFleet(page) {
  await page.route('**/api/me', (route) => route.fulfill({ json: ME }));
  // Nothing changes behind the first answer.
  await page.route(
    (url) => url.pathname === '/api/fleet',
    (route) => (route.request().url().endsWith('since=0') ? route.fulfill({ json: FLEET }) : undefined),
  );
}
