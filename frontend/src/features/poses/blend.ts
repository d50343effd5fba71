// A pose between two others, looked at before anything goes there: the body shows it, and where the person switched that on the
// robot goes along with the slider. STOP and a lost link switch it off. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Device } from '../../robot/device.ts';
import { endsMotion } from '../../robot/readiness.ts';
import { freeOf, type Locking } from '../servoView.ts';
import { createFollower } from '../../robot/follower.ts';

export interface BlendState {
  /** null: nothing is looked at. */
  readonly targets: readonly ServoTarget[] | null;
  readonly isLive: boolean;
}

export interface Blend {
  readonly store: StoreApi<BlendState>;
  /** In the unit of the board at hand; null ends it, and the robot stays. */
  show(targets: readonly ServoTarget[] | null): void;
  /** From now on the robot goes there, gently at first, or not any more. */
  follow(isLive: boolean): void;
}

export function createBlend({ device, ...locking }: Locking & { readonly device: Device }): Blend {
  const store = createStore<BlendState>(() => ({ targets: null, isLive: false }));
  const follower = createFollower(device);

  function follow(): void {
    const { targets, isLive } = store.getState();
    if (isLive && targets !== null)
      follower.follow(new Map(freeOf(locking, targets).map(({ servo, position }) => [servo, position])));
  }

  device.store.subscribe(({ snapshot }) => {
    if (store.getState().isLive && endsMotion(snapshot)) store.setState({ isLive: false });
  });

  return {
    store,
    show(targets) {
      store.setState({ targets, isLive: targets !== null && store.getState().isLive });
      follow();
    },
    follow(isLive) {
      if (isLive) follower.begin();
      store.setState({ isLive });
      follow();
    },
  };
}
