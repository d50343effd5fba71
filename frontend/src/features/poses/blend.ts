// The blend of two poses: a preview on the body, and while “follow” is on the robot moves with the slider. STOP and a lost link switch it
// off. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { ServoTarget } from '#shared/codec/commands.ts';
import type { Device } from '../../robot/device.ts';
import { endsMotion } from '../../robot/readiness.ts';
import { freeOf, type Locking } from '../servoView.ts';
import { createFollower } from '../../robot/follower.ts';

export interface BlendState {
  /** null without a preview. */
  readonly targets: readonly ServoTarget[] | null;
  readonly isLive: boolean;
}

export interface Blend {
  readonly store: StoreApi<BlendState>;
  /** In the unit of the connected board; null ends the preview, and the robot stays. */
  show(targets: readonly ServoTarget[] | null): void;
  /** Switches following on, with a slow first move, or off. */
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
