// Where the compiled group may make the robot touch itself or the floor: estimated beside the page each time the group was compiled. The last
// answer stands until the next is there. Knows no geometry; keeps nothing from being sent.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { CollisionPlace } from '#shared/kinematics/collision.ts';
import type { CompiledGroup, CompiledStore } from './compiled.ts';

export interface CollisionState {
  readonly places: readonly CollisionPlace[];
}

export type CollisionStore = StoreApi<CollisionState>;

/** Null: another check was wanted before this one was done. */
export type CollisionCheck = (group: CompiledGroup) => Promise<readonly CollisionPlace[] | null>;

const NONE: readonly CollisionPlace[] = [];

export function createCollisions(
  compiled: CompiledStore,
  loadCheck: () => Promise<CollisionCheck>,
): CollisionStore {
  const store = createStore<CollisionState>(() => ({ places: NONE }));
  let loading: Promise<CollisionCheck> | null = null;

  async function update(group: CompiledGroup): Promise<void> {
    const places = group.frames.length > 0 ? await (await (loading ??= loadCheck()))(group) : NONE;
    if (places !== null && group === compiled.store.getState().latest) store.setState({ places });
  }

  /** An estimate that cannot be made is none: the group is played as before. */
  const check = (group: CompiledGroup): void =>
    void update(group).catch(() => {
      loading = null;
      store.setState({ places: NONE });
    });
  compiled.store.subscribe(({ latest }, before) => {
    if (latest !== before.latest) check(latest);
  });
  check(compiled.store.getState().latest);
  return store;
}
