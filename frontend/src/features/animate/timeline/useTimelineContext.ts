// What small parts of the timeline that show a bit of everything read, anew whenever something of it changed. The playhead is left
// out: what follows it is drawn past React. So is what the servo panel changes all the time while it drags.

import { useShallow } from 'zustand/react/shallow';
import { useDocument, useGroupBoard, useServoView, useStores, useTimeline, useView } from '../../stores.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { rowsNow, type Row } from './rows.ts';
import { useInFrame } from '../../../ui/useInFrame.ts';
import { contextOf, type TimelineContext } from './context.ts';

// The timeline's rows as React sees them: another list only where a row came, went or changed its look.

export function useRows(): readonly Row[] {
  const { robot } = useGroupBoard();
  const hidden = useServoView((view) => view.hidden);
  const folded = useServoView((view) => view.folded);
  const keyed = useDocument(({ present }) => timesOf(present).servos);
  return rowsNow(robot, keyed, { hidden, folded });
}

export type ShownContext = Omit<TimelineContext, 'state'> & {
  readonly state: Omit<TimelineContext['state'], 'playheadMs'>;
};

export function useTimelineContext(): ShownContext {
  const stores = useStores();
  useInFrame(stores.document.store, ({ present }) => present);
  useGroupBoard();
  useView((state) => state.positionsIn);
  useServoView((view) => view);
  useTimeline(useShallow(({ playheadMs: _, ...shown }) => shown));
  return contextOf(stores);
}
