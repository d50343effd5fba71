// New runs and plays of a robot on a cable of this computer while its battery is at the alarm. The gateway's twin:
// backend/tests/test_battery_guard.py.

import { describe, expect, test } from 'vitest';
import { FAMILIES } from '../codec/families.ts';
import { encodeCommand } from '../codec/encode.ts';
import { BATTERY_TIMEOUT_MS } from './timings.ts';
import type { LinkError } from './linkError.ts';
import { createRig } from './rig.ts';

const ALARM_MV = 6600;
const TEN_MINUTES_MS = 600_000;
const FRAMES = [{ durationMs: 1500, targets: [{ servo: 1, position: 1600 }] }];

async function createGuarded(
  batteryMv: number,
  alarmMv: number | null = ALARM_MV,
  profile: 'doc' | 'openarm-new' = 'doc',
) {
  const rig = await createRig({ batteryMv, profile });
  rig.session.refuseRunsBelow(alarmMv);
  let unknown = 0;
  rig.session.subscribe({ batteryUnknown: () => (unknown += 1) });
  const outcomeOf = async (work: Promise<unknown>, withinMs = 2000): Promise<string> => {
    const outcome = work.then(
      () => 'begun',
      (error: unknown) => (error as LinkError).code,
    );
    await rig.clock.advance(withinMs);
    return outcome;
  };
  const left = () => [...rig.ofKind('run'), ...rig.ofKind('move')];
  return { ...rig, outcomeOf, left, unknown: () => unknown };
}

type Guarded = Awaited<ReturnType<typeof createGuarded>>;

const DOORS: readonly (readonly [string, (rig: Guarded, anyway: boolean) => Promise<unknown>])[] = [
  ['run', ({ session }, anyway) => session.run(8, 1, { anyway })],
  ['play', ({ session }, anyway) => session.play(FRAMES, { anyway })],
];

describe.each(DOORS)('%s', (_, begin) => {
  test('is refused at the alarm until a person says anyway', async () => {
    const rig = await createGuarded(6500);
    expect(await rig.outcomeOf(begin(rig, false))).toBe('batteryLow');
    expect(rig.left()).toEqual([]);
    expect(await rig.outcomeOf(begin(rig, true))).toBe('begun');
    expect(rig.left()).not.toEqual([]);
  });

  test.each([
    [6500, null, 0],
    [6650, ALARM_MV, 0],
    [0, ALARM_MV, 1],
  ])('at %i mV with an alarm at %s it begins', async (batteryMv, alarmMv, unknown) => {
    const rig = await createGuarded(batteryMv, alarmMv);
    expect(await rig.outcomeOf(begin(rig, false))).toBe('begun');
    expect([rig.left().length > 0, rig.unknown()]).toEqual([true, unknown]);
  });

  test('begins where the board does not answer, and says so', async () => {
    const rig = await createGuarded(6500, ALARM_MV, 'openarm-new');
    await rig.outcomeOf(begin(rig, false), BATTERY_TIMEOUT_MS + 2000);
    expect([rig.left().length > 0, rig.unknown()]).toEqual([true, 1]);
  });

  test('that waits for the battery is ended by STOP', async () => {
    const rig = await createGuarded(7600);
    const outcome = begin(rig, false).then(
      (played) => (played as { isWhole?: boolean } | undefined)?.isWhole ?? 'begun',
      (error: unknown) => (error as LinkError).code,
    );
    void rig.session.halt();
    await rig.clock.advance(2000);
    expect(['latched', false]).toContain(await outcome);
    expect(rig.ofKind('run')).toEqual([]);
  });
});

test('a packet by hand is judged like any run', async () => {
  const rig = await createGuarded(6500);
  const packet = encodeCommand({ kind: 'run', slot: 8, times: 1 }, FAMILIES.doc);
  expect(await rig.outcomeOf(rig.session.sendRaw(packet))).toBe('batteryLow');
});

test('the last reading at rest counts for ten minutes, then the board is asked', async () => {
  const rig = await createGuarded(7600);
  await rig.outcomeOf(rig.session.readBattery());
  const asked = (): number => rig.ofKind('readBattery').length;
  const before = asked();
  await rig.clock.advance(TEN_MINUTES_MS - 5000);
  expect(await rig.outcomeOf(rig.session.play(FRAMES))).toBe('begun');
  expect(asked()).toBe(before);
  await rig.clock.advance(10_000);
  expect(await rig.outcomeOf(rig.session.play(FRAMES))).toBe('begun');
  expect(asked()).toBe(before + 1);
});
