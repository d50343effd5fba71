// Which frames are selected as a whole, with every key of theirs in a row that is shown, and the rests between them: what the strip
// marks, and what is done to several frames is done to. The list is pure, and kept as long as it says the same.

import type { GroupFrame } from '#shared/group/group.ts';
import { sameList } from '#shared/group/groupEdits.ts';
import type { Key } from '#shared/group/tracks.ts';
import { framesByServo, type KeySet, selectedKeys } from './timeline.ts';
import { useStores } from '../../stores.ts';
import { useInFrame } from '../../../ui/useInFrame.ts';
import { type GroupTimes, timesOf } from '#shared/group/groupTimes.ts';
import { useRows } from './useTimelineContext.ts';

/** In the order of time. A frame without a key to select goes with the frames on both sides of it. */
export function wholeFrames(
  { frames }: Pick<GroupTimes, 'frames'>,
  selected: KeySet,
  shownServos: ReadonlySet<number>,
): readonly number[] {
  const chosen = framesByServo(selected);
  const ids: number[] = [];
  let isBehindWhole = false;
  let rests: number[] = [];
  for (const frame of frames) {
    const state = stateOf(frame, chosen, shownServos);
    if (state === 'rest') {
      rests.push(frame.id);
      continue;
    }
    if (state === 'whole') ids.push(...(isBehindWhole ? rests : []), frame.id);
    isBehindWhole = state === 'whole';
    rests = [];
  }
  return ids;
}

/** By its keys in rows that are shown. */
function stateOf(
  { id, targets }: GroupFrame,
  chosen: ReturnType<typeof framesByServo>,
  shownServos: ReadonlySet<number>,
): 'whole' | 'partial' | 'rest' {
  let state: 'whole' | 'rest' = 'rest';
  for (const { servo } of targets) {
    if (!shownServos.has(servo)) continue;
    if (chosen.get(servo)?.has(id) !== true) return 'partial';
    state = 'whole';
  }
  return state;
}

interface Whole {
  readonly shown: readonly number[];
  readonly ids: readonly number[];
}

/** By the selected keys, of which there is one list for each selection in each state of the group. */
const known = new WeakMap<readonly Key[], Whole>();
let latest: readonly number[] = [];

/** The very same list as before where it says the same: an edit that leaves them the same has nothing drawn again. */
function wholeNow(times: GroupTimes, selected: KeySet, shown: readonly number[]): readonly number[] {
  const keys = selectedKeys(times, selected);
  const before = known.get(keys);
  if (before?.shown === shown) return before.ids;
  latest = sameList(before?.ids ?? latest, wholeFrames(times, selected, new Set(shown)));
  known.set(keys, { shown, ids: latest });
  return latest;
}

/** With the next frame: what an edit of thousands of keys does to strip and tools does not keep the key that made it. */
export function useWholeFrames(): readonly number[] {
  const { document, timeline } = useStores();
  const shown = useRows().find(({ kind }) => kind === 'all')?.servos ?? NO_SERVOS;
  return useInFrame(document.store, ({ present }) =>
    wholeNow(timesOf(present), timeline.getState().selected, shown),
  );
}

const NO_SERVOS: readonly number[] = [];
