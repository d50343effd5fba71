// The timeline's rows as React sees them: another list only where a row came, went or changed its look.

import { useDocument, useGroupBoard, useServoView } from '../../stores.ts';
import { timesOf } from './groupTimes.ts';
import { rowsNow, type Row } from './rows.ts';

export function useRows(): readonly Row[] {
  const { robot } = useGroupBoard();
  const hidden = useServoView((view) => view.hidden);
  const folded = useServoView((view) => view.folded);
  const keyed = useDocument(({ present }) => timesOf(present).servos);
  return rowsNow(robot, keyed, { hidden, folded });
}
