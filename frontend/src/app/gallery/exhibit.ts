// One state in the gallery: its name, its content and its stores, with a frozen robot that does nothing.

import { compileSource } from '../../features/board/compile/compileSource.ts';
import type { ReactNode } from 'react';
import type { DocumentStore } from '#shared/files/documentStore.ts';
import { FAMILIES, type FamilyId, type Family } from '#shared/codec/families.ts';
import type { SessionState, ServoMotion } from '#shared/robot/state.ts';
import { type Way, createDevice } from '../../robot/device.ts';
import { type Gamepadlike, createMappings, createPad } from '../../features/inputs/pad.ts';
import type { Stores } from '../../features/stores.ts';
import { motionsOf, READY, USB, type Pose } from './states.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { pageClock } from '../page.ts';
import { createMemoryStore } from '../../features/library/memoryStore.ts';
import { createBattery } from '../../features/battery/battery.ts';
import { createBlend, createPoses } from '../../features/poses/poses.ts';
import { createBoards, createLastPoses } from '../../robot/remembered.ts';
import { createCollisions } from '../../features/board/compile/collisions.ts';
import { createCompiled } from '../../features/board/compile/compiled.ts';
import { createDocument } from '../../features/groupDocument.ts';
import type { TextStorage } from '../../state/storage.ts';
import { createLibrary } from '../../features/library/library.ts';
import { createMacroRun, createMacros } from '../../features/buttons/macroRun.ts';
import { createMotionTape } from '../../features/animate/play/motionTape.ts';
import { createNotices } from '../../state/notices.ts';
import { createPeople, PeopleError, type PeopleApi } from '../../features/people/people.ts';
import { createPlayback, createPlayhead } from '../../features/animate/play/playback.ts';
import { createTeaching } from '../../features/drive/teaching.ts';
import { createRobotSync } from '../../features/profiles/robotSync.ts';
import { createRobots } from '../../features/profiles/robots.ts';
import { createGroupPlace } from '../../features/board/slots/groupPlace.ts';
import { createReplacing } from '../../features/board/slots/replacing.ts';
import { createSlots } from '../../features/board/slots/slots.ts';
import { createTimeline } from '../../features/animate/timeline/timeline.ts';
import { createView } from '../../features/view.ts';

export interface Exhibit {
  readonly name: string;
  readonly content: ReactNode;
  /** If absent, nothing is connected and the group is empty. */
  stores?(): Stores;
  readonly isInDialog?: boolean;
}

interface Standing {
  readonly board?: FamilyId;
  readonly way?: Way;
  readonly state?: SessionState;
  readonly pose?: Pose;
  readonly pad?: Gamepadlike | null;
  readonly place?: DocumentStore['place'];
}

/** The stores of a page whose link stays in one state. */
export function standing({
  board = 'doc',
  way = USB,
  state = READY,
  pose = 'unknown',
  pad = null,
  place = 'browser',
}: Standing): Stores {
  const family = FAMILIES[board];
  const stores = specimenStores(family, pad, place);
  stores.device.attach(frozenSession(family, state, motionsOf(board, pose)), way);
  stores.device.refresh();
  return stores;
}

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
    limitsChanged: () => undefined,
    move: () => {
      throw new LinkError('latched', 'the gallery moves nothing');
    },
    run: nothing,
    stopGroup: nothing,
    halt: nothing,
    resume: nothing,
    erase: nothing,
    refuseRunsBelow: () => undefined,
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
    isMoving: () => false,
  };
}

const none = () => Promise.reject(new PeopleError('unreachable', ''));
const NO_PEOPLE: PeopleApi = {
  ...{ me: () => Promise.resolve(null), sayName: none },
  ...{ list: none, invite: none, withdraw: none, change: none, revoke: none },
  ...{ makeToken: none, makeStopLink: none },
};
const NO_STORAGE: TextStorage = { getItem: () => null, setItem: () => undefined };

export function specimenStores(
  family: Family,
  held: Gamepadlike | null = null,
  libraryPlace: DocumentStore['place'] = 'browser',
): Stores {
  const notices = createNotices(pageClock);
  const robots = createRobots(NO_STORAGE, notices);
  const device = createDevice({ family, clock: pageClock, notices, robots });
  const view = createView({ browser: NO_STORAGE, tab: NO_STORAGE });
  const poses = createPoses({ storage: NO_STORAGE, notices, robots, device, view });
  const mappings = createMappings(NO_STORAGE, notices, robots);
  const document = createDocument(NO_STORAGE, notices, pageClock);
  const compiled = createCompiled({
    ...{ document, device, robots, clock: pageClock },
    compileElsewhere: (source) => Promise.resolve(compileSource(source)),
  });
  const slots = createSlots({ device, robots, notices, storage: NO_STORAGE, today: Date.now });
  const timeline = createTimeline();
  const playhead = createPlayhead(timeline);
  const readPads = () => [held];
  let ids = 0;
  const stored = {
    ...{ storage: NO_STORAGE, notices, robots, clock: pageClock },
    documentStore: Promise.resolve(createMemoryStore(libraryPlace)),
    epochMs: Date.now,
    newId: () => `specimen-${++ids}`,
  };
  const library = createLibrary({ ...stored, document, view });
  const place = createGroupPlace({ document, opened: library.store, view, slots, device });
  const replacing = createReplacing({ device, robots, slots, place });
  const macros = createMacros(NO_STORAGE, notices, robots);
  const robotSync = createRobotSync({
    ...{ ...stored, poses: poses.book, buttons: macros, pad: mappings, mayWrite: true },
  });
  return {
    ...{ notices, robots, device, poses, mappings, document, view, library, robotSync },
    pad: createPad({ device, robots, view, poses, mappings, notices, clock: pageClock, readPads }),
    battery: createBattery(device, robots),
    blend: createBlend({ device, robots, view }),
    teaching: createTeaching({ device, robots, notices }),
    timeline,
    people: createPeople({ api: NO_PEOPLE, me: null, notices, now: pageClock.now }),
    ...{ compiled, slots, place, replacing, playhead },
    collisions: createCollisions(compiled, () => Promise.resolve(() => Promise.resolve([]))),
    tape: createMotionTape({ device, robots, clock: pageClock }),
    playback: createPlayback({
      ...{ device, document, compiled, slots, place, replacing, notices, view, playhead, robots },
      documentId: () => library.store.getState().openId,
    }),
    boards: createBoards(NO_STORAGE),
    lastPoses: createLastPoses(NO_STORAGE, device),
    macros,
    macroRun: createMacroRun({ device, poses, robots, notices, clock: pageClock }),
  };
}
