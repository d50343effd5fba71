// What the timeline's own parts read, anew whenever something of it changed. The playhead is left out: what follows it is drawn
// past React.

import { useMemo } from 'react';
import { useStore } from 'zustand';
import { useShallow } from 'zustand/react/shallow';
import { useDevice, useGroup, useRobot, useServoView, useStores, useView } from '../stores/stores.ts';
import { type Desk } from './desk.ts';
import { timesOf } from './groupTimes.ts';
import { rowsOf } from './rows.ts';

export type SeenDesk = Omit<Desk, 'state'> & { readonly state: Omit<Desk['state'], 'playheadMs'> };

export function useDesk(): SeenDesk {
  const stores = useStores();
  const group = useGroup();
  const robot = useRobot();
  const family = useDevice((state) => state.family);
  const servoView = useServoView((view) => view);
  const positionsIn = useView((view) => view.positionsIn);
  const state = useStore(
    stores.timeline,
    useShallow(({ playheadMs: _, ...rest }) => rest),
  );
  return useMemo(() => {
    const times = timesOf(group);
    return {
      stores,
      group,
      times,
      robot,
      family,
      servoView,
      positionsIn,
      state,
      rows: rowsOf(robot, times.tracks, servoView),
    };
  }, [stores, group, robot, family, servoView, positionsIn, state]);
}
