// A robot that stays in one state and does nothing: it holds a panel still so that it can be looked at.

import { LinkError } from '#shared/robot/linkError.ts';
import type { Family } from '#shared/codec/families.ts';
import type { Robot } from '#shared/robot/robot.ts';
import type { ServoMotion, SessionState } from '#shared/robot/state.ts';

export function frozenSession(
  family: Family,
  state: SessionState,
  motions: Readonly<Record<number, ServoMotion>>,
): Robot {
  const nothing = (): Promise<void> => Promise.resolve();
  return {
    state: { ...state, family },
    subscribe: () => () => undefined,
    open: nothing,
    close: nothing,
    retryNow: () => undefined,
    takeOver: nothing,
    leave: () => undefined,
    setAutoReconnect: () => undefined,
    identify: nothing,
    choose: nothing,
    lease: () => undefined,
    letRun: () => undefined,
    calibrate: () => undefined,
    move: () => {
      throw new LinkError('latched', 'the gallery moves nothing');
    },
    run: nothing,
    stopGroup: nothing,
    halt: nothing,
    resume: nothing,
    erase: nothing,
    readBattery: () => Promise.resolve(0),
    readPositions: nothing,
    readVersion: nothing,
    readOffsets: nothing,
    setSpeed: nothing,
    release: nothing,
    download: nothing,
    cancelDownload: nothing,
    sendRaw: nothing,
    play: () => Promise.resolve({ lateFrames: 0, latestMs: 0, skippedFrames: 0, isWhole: true }),
    stopPlaying: () => undefined,
    motions: () => (servo) => motions[servo] ?? { target: null, estimated: null },
  };
}
