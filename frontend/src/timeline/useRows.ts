// The timeline's rows as React sees them: another list only where a row came, went or changed its look.

import { useMemo } from 'react';
import { useDocument, useRobot, useServoView } from '../stores/stores.ts';
import { timesOf } from './groupTimes.ts';
import { rowsOf, type Row } from './rows.ts';

export function useRows(): readonly Row[] {
  const robot = useRobot();
  const hidden = useServoView((view) => view.hidden);
  const folded = useServoView((view) => view.folded);
  const keyed = useDocument(({ present }) => JSON.stringify([...timesOf(present).tracks.keys()]));
  return useMemo(
    () => rowsOf(robot, JSON.parse(keyed) as number[], { hidden, folded }),
    [robot, keyed, hidden, folded],
  );
}
