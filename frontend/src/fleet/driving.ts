// One robot driven from the fleet page: answers each report of the robot with a beat while the page is seen, and with the newest target of
// each servo. Sends no target that is old, and none a second time. Knows no socket and no view.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import type { DriveChannel, DriveListener } from './driveChannel.ts';
import type { DriveLease, DriveLive, DriveNews } from './drive.generated.ts';

/** So long a target of this page is shown in place of the robot's own, which comes a little later; then it is not sent any more, either. */
const OWN_MS = 400;
/** A robot that is driven reports twenty times a second: without a report for so long, nothing is known of it. */
const QUIET_MS = 1000;

export interface DrivingState {
  readonly link: 'opening' | 'open' | 'ended';
  /** Why it has ended; empty where that is not known. */
  readonly reason: string;
  readonly lease: DriveLease['lease'];
  readonly driver: string | null;
  readonly latch: boolean;
  readonly motion: DriveLive['motion'];
  /** There has been no report for a while: what is shown is old. */
  readonly isQuiet: boolean;
  /** Targets of this page that the robot has not confirmed yet. */
  readonly own: ReadonlyMap<number, number>;
  /** Why the latest wish was refused; empty where it was not. */
  readonly refusal: string;
}

export interface Driving {
  readonly store: StoreApi<DrivingState>;
  move(servo: number, position: number, durationMs: number): void;
  run(slot: number): void;
  /** Asks for the lease again. */
  request(): void;
  /** A page that is not seen does not beat: its robot stops. */
  see(isSeen: boolean): void;
  /** Gives the lease back. */
  end(): void;
}

interface Waiting {
  readonly targets: ReadonlyMap<number, number>;
  readonly durationMs: number;
  readonly atMs: number;
}

export function createDriving(
  open: (listener: DriveListener) => DriveChannel,
  { now, after }: Clock,
): Driving {
  const store = createStore<DrivingState>(() => ({
    ...{ link: 'opening', reason: '', lease: 'requested', driver: null, latch: false, motion: null },
    ...{ isQuiet: false, own: new Map(), refusal: '' },
  }));
  let nonce: string | null = null;
  let isSeen = true;
  let waiting: Waiting | null = null;
  let ownMs = 0;
  let stopWaiting = (): void => undefined;

  const hasEnded = (): boolean => store.getState().link === 'ended';
  const drives = (): boolean => store.getState().lease === 'driving' && !hasEnded();

  function heard(news: DriveNews): void {
    if (hasEnded()) return;
    switch (news.type) {
      case 'lease':
        store.setState({ link: 'open', lease: news.lease, driver: news.driver });
        break;
      case 'refused':
        waiting = null;
        store.setState({ refusal: news.detail, own: new Map() });
        break;
      case 'live':
        heardLive(news);
    }
  }

  function heardLive(news: DriveLive): void {
    nonce = news.nonce;
    stopWaiting();
    stopWaiting = after(QUIET_MS, () => {
      if (drives()) store.setState({ isQuiet: true, own: new Map() });
    });
    const { own, motion } = store.getState();
    const isConfirmed = news.latch || now() - ownMs > OWN_MS;
    store.setState({
      ...{ latch: news.latch, motion: news.motion ?? motion, isQuiet: false },
      ...(isConfirmed && own.size > 0 && { own: new Map() }),
    });
    if (news.latch) waiting = null;
    if (!isSeen) return;
    channel.send({ type: 'beat', nonce });
    if (waiting === null || !drives() || now() - waiting.atMs > OWN_MS) return;
    const { targets, durationMs } = waiting;
    waiting = null;
    channel.send({
      ...{ type: 'move', durationMs, nonce },
      targets: [...targets].map(([servo, position]) => ({ servo, position })),
    });
  }

  const channel = open({
    heard,
    ended: (reason) => {
      stopWaiting();
      if (!hasEnded()) store.setState({ link: 'ended', reason, lease: 'none', own: new Map() });
    },
  });

  return {
    store,
    move(servo, position, durationMs) {
      if (!drives() || !isSeen || store.getState().latch || store.getState().isQuiet) return;
      ownMs = now();
      const before = waiting !== null && ownMs - waiting.atMs <= OWN_MS ? waiting.targets : [];
      waiting = { targets: new Map([...before, [servo, position]]), durationMs, atMs: ownMs };
      store.setState(({ own }) => ({ own: new Map([...own, [servo, position]]), refusal: '' }));
    },
    run(slot) {
      store.setState({ refusal: '' });
      if (nonce !== null) channel.send({ type: 'run', slot, nonce });
    },
    request() {
      store.setState({ refusal: '' });
      channel.send({ type: 'request' });
    },
    see(seen) {
      isSeen = seen;
      if (!seen) waiting = null;
    },
    end() {
      if (hasEnded()) return;
      stopWaiting();
      channel.send({ type: 'release' });
      store.setState({ link: 'ended', reason: '', lease: 'none' });
    },
  };
}
