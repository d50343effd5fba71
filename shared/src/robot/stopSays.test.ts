// What STOP says, against what the simulated board does: over generated histories of every verb of the page, "all is held" means
// that no pulse changes later than 150 ms after the last byte, and what is named is all that moves, for no longer than is said.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import stops from '../../protocol/vectors/stops.json' with { type: 'json' };
import { LONGEST_DEAFNESS_MS } from '../motion/motion.ts';
import { SIMULATED } from './estimateUnderTest.ts';
import type { ProfileName } from '../simulator/profileNames.ts';
import { TIMES } from '../testing/cases.ts';
import { SERVOS, somePlainHistory, someStopHistory, type StopHistory } from './historiesUnderTest.ts';
import { SELDOM_MS, stopped, type StopOutcome, type StopWord } from './stopUnderTest.ts';

const HELD_WITHIN_MS = 150;
/** The robot is looked at that often while it shall be held. */
const LOOKED_MS = 5;
/** Least share of histories in which all is held: without it, "may move on" for ever would be right. */
const LEAST_HELD = 0.3;
/**
 * Where STOP says which servos go on, no hold throws a servo any farther than that in a tick, and none takes one of the others back
 * by more.
 */
const HOLD_LIMIT = 30;
const TIMEOUT_MS = 3_600_000;

/** Servos that a hold moved otherwise than it may. */
function brokenHolds({ unheld, backBy, longestStep }: StopOutcome): readonly string[] {
  if (unheld?.servos === null) return [];
  const named = new Set(unheld?.servos);
  const back = SERVOS.flatMap((servo, index) => {
    const by = backBy[index] ?? 0;
    return by > HOLD_LIMIT && !named.has(servo) ? [`servo ${servo} was taken back by ${by}`] : [];
  });
  return longestStep > HOLD_LIMIT ? [...back, `a step of ${longestStep}`] : back;
}

/** Servos that moved longer than STOP said then, with their time. */
function broken({ words }: StopOutcome): readonly string[] {
  return words.flatMap(brokenWord);
}

function brokenWord({ unheld, movedForMs, sentForMs }: StopWord): readonly string[] {
  return movedForMs.flatMap((forMs, index) => {
    const servo = SERVOS[index] ?? 0;
    const isNamed = unheld !== null && (unheld.servos === null || unheld.servos.includes(servo));
    const limitMs = isNamed ? unheld.forMs + SELDOM_MS : sentForMs + HELD_WITHIN_MS + LOOKED_MS;
    return forMs > limitMs ? [`servo ${servo} moved for ${forMs} ms, limit ${limitMs}`] : [];
  });
}

describe.each(SIMULATED)('$profile', ({ profile }) => {
  test(
    'does what STOP says',
    async () => {
      let all = 0;
      let held = 0;
      await fc.assert(
        fc.asyncProperty(someStopHistory(profile), async (history) => {
          const outcome = await stopped(profile, history);
          all += 1;
          held += outcome.unheld === null ? 1 : 0;
          expect(broken(outcome), JSON.stringify(outcome)).toEqual([]);
          expect(brokenHolds(outcome), JSON.stringify(outcome)).toEqual([]);
        }),
        { numRuns: 15 * TIMES },
      );
      expect(held / all).toBeGreaterThan(LEAST_HELD);
    },
    TIMEOUT_MS,
  );
});

/** A hold where the place is unknown takes the time of a first move; the last one leaves 160 ms behind the press, and is said again twice. */
const SLOWEST_HOLD_MS = 1_900;

/** What is named though nothing that the history knows can move it, or can move it that long. */
function tooMuch({ known, steps }: StopHistory, { unheld }: StopOutcome): readonly string[] {
  if (unheld === null) return [];
  if (unheld.servos === null) return ['any servo'];
  const isRun = steps.some(({ kind }) => kind === 'run');
  const moves = steps.filter((step) => step.kind === 'move');
  const requested = [...moves, ...(isRun ? known : [])];
  const movable = new Set([
    ...SERVOS.slice(0, 2),
    ...requested.flatMap(({ targets }) => targets.map(({ servo }) => servo)),
  ]);
  const isDeaf = steps.some(({ kind }) => kind === 'read');
  const longestMs = Math.max(...requested.map(({ durationMs }) => durationMs), 0);
  const limitMs = longestMs + SLOWEST_HOLD_MS + (isDeaf ? LONGEST_DEAFNESS_MS : 0);
  return [
    ...unheld.servos
      .filter((servo) => !movable.has(servo))
      .map((servo) => `servo ${servo} was not asked to move`),
    ...(unheld.forMs > limitMs ? [`for ${unheld.forMs} ms, longest ${limitMs}`] : []),
  ];
}

test.each(SIMULATED)(
  '$profile: names no more than what may move, where all that moves it is known',
  async ({ profile }) => {
    await fc.assert(
      fc.asyncProperty(somePlainHistory(profile), async (history) => {
        const outcome = await stopped(profile, history);
        expect(tooMuch(history, outcome), JSON.stringify(outcome)).toEqual([]);
        expect(broken(outcome), JSON.stringify(outcome)).toEqual([]);
      }),
      { numRuns: 15 * TIMES },
    );
  },
  TIMEOUT_MS,
);

const PLAIN = { hasPad: true, isSlow: false, wasErased: false };

test.each(['doc', 'openarm-old', 'openarm-new'] as const)(
  '%s: a servo that a move and a frame contest is held as fast as a first move goes',
  async (profile) => {
    const history: StopHistory = {
      ...{ ...PLAIN, onForMs: 60_000 },
      unknown: [{ durationMs: 0, targets: [{ servo: 6, position: 500 }] }],
      known: [{ durationMs: 1, targets: [{ servo: 6, position: 500 }] }],
      steps: [
        { kind: 'move', durationMs: 0, targets: [{ servo: 6, position: 501 }] },
        { kind: 'run', slot: 5, times: 1 },
        { kind: 'wait', ms: 1500 },
        { kind: 'move', durationMs: 0, targets: [{ servo: 1, position: 500 }] },
        { kind: 'endGroup' },
      ],
    };
    const outcome = await stopped(profile, history);
    const wrong = [...tooMuch(history, outcome), ...broken(outcome), ...brokenHolds(outcome)];
    expect(wrong, JSON.stringify(outcome)).toEqual([]);
  },
);

test.each(['bus-ctrl', 'xarm'] as const)('%s: behind a reading only what moves is named', async (profile) => {
  const steps: StopHistory['steps'] = [
    { kind: 'move', durationMs: 1500, targets: [{ servo: 1, position: 100 }] },
    { kind: 'wait', ms: 300 },
    { kind: 'read' },
    { kind: 'wait', ms: 60 },
  ];
  const history: StopHistory = { ...PLAIN, onForMs: 60_000, unknown: [], known: [], steps };
  const outcome = await stopped(profile, history);
  expect([...tooMuch(history, outcome), ...broken(outcome)], JSON.stringify(outcome)).toEqual([]);
  expect(outcome.unheld?.servos).toEqual([1]);
});

test('what goes on is counted from the press also where a stop is sent once more', async () => {
  const steps: StopHistory['steps'] = [
    { kind: 'move', durationMs: 2440, targets: [{ servo: 1, position: 0 }] },
    { kind: 'wait', ms: 21 },
    { kind: 'read' },
    { kind: 'endGroup' },
  ];
  const history: StopHistory = { ...PLAIN, onForMs: 60_000, unknown: [], known: [], steps };
  const outcome = await stopped('bus-ctrl', history);
  expect(broken(outcome), JSON.stringify(outcome)).toEqual([]);
});

const FOUND: readonly {
  readonly name: string;
  readonly profile: 'doc' | 'learm-esp32' | 'openarm-new' | 'openarm-old' | 'lsc-32';
  readonly history: StopHistory;
}[] = [
  {
    name: 'a move and a frame of one moment may be taken in either order',
    profile: 'openarm-old',
    history: {
      ...{ ...PLAIN, hasPad: false, onForMs: 60_040 },
      unknown: [{ durationMs: 20, targets: [{ servo: 1, position: 1000 }] }],
      known: [
        {
          durationMs: 20,
          targets: [
            { servo: 1, position: 1890 },
            { servo: 2, position: 1779 },
            { servo: 6, position: 2251 },
          ],
        },
      ],
      steps: [
        { kind: 'run', slot: 5, times: 2 },
        { kind: 'move', durationMs: 0, targets: [{ servo: 6, position: 956 }] },
        { kind: 'wait', ms: 1778 },
      ],
    },
  },
  {
    name: 'a frame that begins with a STOP may not have re-timed the moves before it',
    profile: 'openarm-old',
    history: {
      ...{ ...PLAIN, onForMs: 60_071 },
      unknown: [{ durationMs: 20, targets: [{ servo: 1, position: 1000 }] }],
      known: [
        {
          durationMs: 40,
          targets: [
            { servo: 1, position: 717 },
            { servo: 2, position: 1075 },
            { servo: 6, position: 1329 },
          ],
        },
        { durationMs: 60, targets: [{ servo: 2, position: 2412 }] },
        {
          durationMs: 300,
          targets: [
            { servo: 1, position: 2185 },
            { servo: 6, position: 1138 },
          ],
        },
      ],
      steps: [
        { kind: 'run', slot: 5, times: 2 },
        { kind: 'wait', ms: 3 },
        { kind: 'move', durationMs: 0, targets: [{ servo: 2, position: 1556 }] },
        { kind: 'wait', ms: 2 },
        { kind: 'move', durationMs: 20, targets: [{ servo: 6, position: 2064 }] },
        { kind: 'move', durationMs: 0, targets: [{ servo: 1, position: 2302 }] },
        { kind: 'wait', ms: 13 },
      ],
    },
  },
  {
    name: 'moves go on where the frame that re-times them may not have begun',
    profile: 'openarm-old',
    history: {
      ...{
        ...PLAIN,
        onForMs: 60_069,
        unknown: [{ durationMs: 20, targets: [{ servo: 1, position: 1000 }] }],
        known: [
          {
            durationMs: 300,
            targets: [
              { servo: 1, position: 712 },
              { servo: 2, position: 1094 },
              { servo: 6, position: 1308 },
            ],
          },
        ],
        steps: [
          { kind: 'run', slot: 5, times: 2 },
          { kind: 'wait', ms: 30 },
          { kind: 'move', targets: [{ servo: 1, position: 935 }], durationMs: 0 },
          { kind: 'wait', ms: 23 },
          { kind: 'move', targets: [{ servo: 2, position: 759 }], durationMs: 0 },
          { kind: 'wait', ms: 8 },
          { kind: 'move', targets: [{ servo: 2, position: 991 }], durationMs: 0 },
          { kind: 'wait', ms: 5 },
          { kind: 'move', targets: [{ servo: 6, position: 750 }], durationMs: 0 },
          { kind: 'wait', ms: 13 },
          { kind: 'wait', ms: 225 },
        ],
      },
    },
  },
  {
    name: 'of two frames just before a STOP neither may have begun',
    profile: 'openarm-old',
    history: {
      ...{
        ...PLAIN,
        onForMs: 60_055,
        unknown: [{ durationMs: 20, targets: [{ servo: 1, position: 1000 }] }],
        known: [
          {
            durationMs: 60,
            targets: [
              { servo: 1, position: 1515 },
              { servo: 2, position: 1687 },
              { servo: 6, position: 2271 },
            ],
          },
          {
            durationMs: 20,
            targets: [
              { servo: 1, position: 1701 },
              { servo: 2, position: 754 },
              { servo: 6, position: 1597 },
            ],
          },
        ],
        steps: [
          { kind: 'run', slot: 5, times: 2 },
          { kind: 'wait', ms: 20 },
          { kind: 'move', targets: [{ servo: 2, position: 1867 }], durationMs: 20 },
          { kind: 'wait', ms: 12 },
          { kind: 'move', targets: [{ servo: 1, position: 509 }], durationMs: 20 },
          { kind: 'wait', ms: 18 },
          { kind: 'move', targets: [{ servo: 1, position: 1431 }], durationMs: 0 },
          { kind: 'wait', ms: 8 },
          { kind: 'move', targets: [{ servo: 6, position: 679 }], durationMs: 20 },
          { kind: 'wait', ms: 19 },
          { kind: 'wait', ms: 4 },
        ],
      },
    },
  },
  {
    name: 'a servo is on its way from where an unknown group left it',
    profile: 'lsc-32',
    history: {
      ...{ ...PLAIN, onForMs: 60_106 },
      unknown: [{ durationMs: 20, targets: [{ servo: 1, position: 1000 }] }],
      known: [{ durationMs: 20, targets: [{ servo: 1, position: 1890 }] }],
      steps: [
        { kind: 'move', durationMs: 168, targets: [{ servo: 2, position: 1934 }] },
        {
          kind: 'move',
          durationMs: 11,
          targets: [
            { servo: 2, position: 551 },
            { servo: 6, position: 1405 },
          ],
        },
        { kind: 'run', slot: 1, times: 2 },
        { kind: 'wait', ms: 88 },
        { kind: 'cancel' },
        { kind: 'wait', ms: 1565 },
        {
          kind: 'move',
          durationMs: 0,
          targets: [
            { servo: 1, position: 1038 },
            { servo: 2, position: 2327 },
          ],
        },
        { kind: 'wait', ms: 606 },
      ],
    },
  },
  {
    name: 'a STOP that does not leave holds nothing',
    profile: 'learm-esp32',
    history: {
      ...{ onForMs: 60_002, hasPad: false, isSlow: true, wasErased: false },
      unknown: [{ durationMs: 295, targets: [{ servo: 2, position: 1271 }] }],
      known: [{ durationMs: 300, targets: [{ servo: 1, position: 697 }] }],
      steps: [
        { kind: 'wait', ms: 58 },
        {
          kind: 'move',
          durationMs: 52,
          targets: [
            { servo: 2, position: 659 },
            { servo: 6, position: 1722 },
          ],
        },
        { kind: 'run', slot: 77, times: 2 },
        {
          kind: 'download',
          slot: 9,
          frames: [{ durationMs: 3001, targets: [{ servo: 2, position: 1606 }] }],
        },
        { kind: 'halt' },
        { kind: 'wait', ms: 1259 },
        { kind: 'loss', awayMs: 50 },
      ],
    },
  },
  {
    name: 'a group that has ended was re-timed by a move that left before',
    profile: 'doc',
    history: {
      ...PLAIN,
      onForMs: 60_065,
      unknown: [{ durationMs: 3, targets: [{ servo: 6, position: 2193 }] }],
      known: [{ durationMs: 20, targets: [{ servo: 2, position: 505 }] }],
      steps: [
        { kind: 'wait', ms: 42 },
        { kind: 'run', slot: 7, times: 2 },
        { kind: 'move', durationMs: 186, targets: [{ servo: 1, position: 514 }] },
        { kind: 'wait', ms: 109 },
      ],
    },
  },
  {
    name: 'a known frame re-times what an unknown group has left on its way',
    profile: 'doc',
    history: {
      ...PLAIN,
      onForMs: 60_075,
      unknown: [
        { durationMs: 288, targets: [{ servo: 1, position: 505 }] },
        { durationMs: 2, targets: [{ servo: 1, position: 506 }] },
      ],
      known: [
        {
          durationMs: 20,
          targets: [
            { servo: 1, position: 502 },
            { servo: 2, position: 1922 },
            { servo: 6, position: 634 },
          ],
        },
        {
          durationMs: 5458,
          targets: [
            { servo: 1, position: 1253 },
            { servo: 2, position: 503 },
            { servo: 6, position: 2086 },
          ],
        },
        {
          durationMs: 132,
          targets: [
            { servo: 1, position: 767 },
            { servo: 2, position: 1383 },
          ],
        },
      ],
      steps: [
        { kind: 'wait', ms: 1742 },
        { kind: 'run', slot: 7, times: 0 },
        { kind: 'run', slot: 5, times: 1 },
        { kind: 'move', durationMs: 4996, targets: [{ servo: 2, position: 1796 }] },
        { kind: 'move', durationMs: 20, targets: [{ servo: 1, position: 641 }] },
        {
          kind: 'move',
          durationMs: 0,
          targets: [
            { servo: 2, position: 1810 },
            { servo: 6, position: 1861 },
          ],
        },
        {
          kind: 'move',
          durationMs: 40,
          targets: [
            { servo: 1, position: 2092 },
            { servo: 6, position: 1740 },
          ],
        },
        { kind: 'endGroup' },
        { kind: 'wait', ms: 373 },
      ],
    },
  },
  {
    name: 'a short frame that has not begun leaves a servo where it stood',
    profile: 'doc',
    history: {
      ...{ onForMs: 60_000, hasPad: true, isSlow: false, wasErased: true },
      unknown: [{ durationMs: 0, targets: [{ servo: 2, position: 500 }] }],
      known: [
        { durationMs: 20, targets: [{ servo: 6, position: 500 }] },
        {
          durationMs: 0,
          targets: [
            { servo: 1, position: 500 },
            { servo: 6, position: 1531 },
          ],
        },
        { durationMs: 0, targets: [{ servo: 1, position: 501 }] },
      ],
      steps: [
        { kind: 'wait', ms: 89 },
        { kind: 'run', slot: 5, times: 3 },
        { kind: 'wait', ms: 70 },
        { kind: 'run', slot: 5, times: 0 },
      ],
    },
  },
  {
    name: 'a frame that has not begun leaves a servo at a place that is unknown',
    profile: 'openarm-new',
    history: {
      ...{ onForMs: 60_000, hasPad: true, isSlow: false, wasErased: true },
      unknown: [{ durationMs: 0, targets: [{ servo: 2, position: 500 }] }],
      known: [
        { durationMs: 1, targets: [{ servo: 2, position: 500 }] },
        { durationMs: 1, targets: [1, 2, 6].map((servo) => ({ servo, position: 500 })) },
      ],
      steps: [
        { kind: 'wait', ms: 14 },
        { kind: 'move', durationMs: 380, targets: [{ servo: 1, position: 500 }] },
        { kind: 'wait', ms: 60 },
        { kind: 'run', slot: 5, times: 0 },
      ],
    },
  },
];

describe('what longer runs found', () => {
  test.each(FOUND)('$name', async ({ profile, history }) => {
    for (const laterMs of [0, 5, 10]) {
      const steps = [{ kind: 'wait' as const, ms: laterMs }, ...history.steps];
      const outcome = await stopped(profile, { ...history, steps });
      expect([...broken(outcome), ...brokenHolds(outcome)], JSON.stringify(outcome)).toEqual([]);
    }
  });
});

/** What the gateway's runs found; it replays them at each of its doors (backend/tests/test_stop_says.py). */
describe.each(stops)('$name', ({ boards, history }) => {
  test.each(boards as readonly ProfileName[])('on %s', async (profile) => {
    const outcome = await stopped(profile, history as StopHistory);
    expect([...broken(outcome), ...brokenHolds(outcome)], JSON.stringify(outcome)).toEqual([]);
  });
});
