// A session on a simulated board whose log is kept, for tests: what a person would save after doing something there.

import { createRig, type Rig } from '../robot/rig.ts';
import { createHappeningsReader, entryOf } from '../files/recorder.ts';
import type { Entry } from '../files/recording.ts';

/** The log begins with the link that is open already. */
export async function createRecordingRig(
  ...options: Parameters<typeof createRig>
): Promise<{ readonly rig: Rig; readonly entries: readonly Entry[] }> {
  const rig = await createRig(...options);
  const entries: Entry[] = [];
  const happenings = createHappeningsReader();
  const atMs = (): number => Math.round(rig.clock.now());
  function note(): void {
    for (const happening of happenings(rig.session.state))
      entries.push({ atMs: atMs(), mark: 'link', happening });
  }
  note();
  rig.session.subscribe({
    state: note,
    traffic: (traffic) => entries.push({ ...entryOf(traffic), atMs: atMs() }),
  });
  return { rig, entries };
}
