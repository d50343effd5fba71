import { expect, test } from 'vitest';
import { createStore } from 'zustand/vanilla';
import type { Lease } from '#shared/robot/lease.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import type { DeviceState } from '../../robot/device.ts';
import { tellHandedOver } from './LeaseChip.tsx';

const OURS: Lease = {
  ...{
    driver: 'Bert',
    drives: true,
    requestedBy: null,
    hasRequested: false,
    grantedInMs: null,
    mayDrive: true,
  },
  ...{ you: 'Bert', mayTake: false, grantedBy: null, candidates: [], others: 2, unattended: null },
};

test('the person who gets the robot is shown who gave it, once', () => {
  const texts: string[] = [];
  const store = createStore<DeviceState>(() => ({
    ...{
      family: FAMILIES.doc,
      way: null,
      known: [],
      readServos: [],
      isMoving: false,
      snapshot: INITIAL_STATE,
    },
  }));
  tellHandedOver(store, { show: (_tone, text) => void texts.push(text) });
  const given = { ...OURS, grantedBy: 'Anna' };
  const theirs = { ...OURS, driver: 'Anna', drives: false };
  for (const lease of [OURS, given, { ...given, others: 3 }, theirs, OURS, null, given]) {
    store.setState({ snapshot: { ...INITIAL_STATE, lease } });
  }
  expect(texts).toEqual(['Anna handed the robot to you', 'Anna handed the robot to you']);
});
