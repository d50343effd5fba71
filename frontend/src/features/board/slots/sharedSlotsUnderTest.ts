// The slots of a board shared by a gateway, for tests: this page and others can store groups in them.

import { fingerprintOf } from '#shared/group/fingerprint.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { Robot } from '#shared/robot/robot.ts';
import type {
  SessionEvents,
  SessionState,
  SlotGroup,
  SlotVersions,
  StoredGroup,
} from '#shared/robot/state.ts';

type SlotState = Pick<SessionState, 'slotVersions' | 'storedSlots' | 'lastDownload'>;

export function createSharedSlots(before: SlotVersions = {}) {
  let versions = before;
  let changed = (): void => undefined;
  const requested: SlotGroup[] = [];

  /** The robot, with the gateway's slots in place of its own. */
  function share(robot: Robot): Robot {
    let seen: SlotState = { slotVersions: versions, storedSlots: [], lastDownload: null };
    const listeners = new Set<Partial<SessionEvents>>();
    const withSlots = (state: SessionState): SessionState => ({ ...state, ...seen });

    function show(patch: Partial<SlotState> = {}): void {
      seen = { ...seen, slotVersions: versions, ...patch };
      for (const listener of listeners) listener.state?.(withSlots(robot.state));
    }

    function download(groups: readonly SlotGroup[]): Promise<void> {
      requested.push(...groups);
      if (groups.some(({ slot, replaces }) => replaces !== (versions[slot]?.version ?? '')))
        return Promise.reject(new LinkError('slotChanged', 'something else is there'));
      versions = { ...versions, ...Object.fromEntries(groups.map(stored)) };
      const slots = groups.map(({ slot }) => slot);
      show({
        lastDownload: { slots, groupsStored: groups.length },
        storedSlots: [...new Set([...seen.storedSlots, ...slots])].sort((a, b) => a - b),
      });
      return Promise.resolve();
    }

    changed = show;
    const shared: Partial<PropertyDescriptorMap> = { state: { get: () => withSlots(robot.state) } };
    const sharing: Robot = {
      ...robot,
      download,
      cancelDownload: () => Promise.resolve(),
      subscribe(listener) {
        listeners.add(listener);
        const { state, ...others } = listener;
        const end = robot.subscribe({ ...others, ...(state && { state: (next) => state(withSlots(next)) }) });
        return () => {
          listeners.delete(listener);
          end();
        };
      },
    };
    return Object.defineProperties(sharing, shared as PropertyDescriptorMap);
  }

  return {
    requested,
    share,
    versions: () => versions,
    /** Reported at once, or only to pages that connect later. */
    othersStore(slot: number, stored: Partial<StoredGroup>, isReported = true) {
      versions = { ...versions, [slot]: storedGroup(stored) };
      if (isReported) changed();
    },
    othersErase() {
      versions = {};
      changed();
    },
  };
}

export const storedGroup = (stored: Partial<StoredGroup>): StoredGroup => ({
  ...{ version: 'a version', name: '', documentId: null, by: '', atMs: null },
  ...stored,
});

const stored = ({ slot, frames, name = '', documentId = null }: SlotGroup) =>
  [slot, storedGroup({ version: fingerprintOf(frames), name, documentId })] as const;
