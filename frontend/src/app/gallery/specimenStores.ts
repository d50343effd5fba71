// The page's stores with nothing in them and nothing behind them, for one specimen.

import type { DocumentStore } from '#shared/files/documentStore.ts';
import type { Family } from '#shared/codec/families.ts';
import { pageClock } from '../page.ts';
import { createMemoryStore } from '../../features/library/memoryStore.ts';
import { createBattery } from '../../features/battery/battery.ts';
import { createBlend } from '../../features/poses/blend.ts';
import { createBoards } from '../../robot/remembered.ts';
import { createCompiled } from '../../features/board/compile/compiled.ts';
import { createDevice } from '../../robot/device.ts';
import { createDocument } from '../../features/groupDocument.ts';
import type { TextStorage } from '../../state/soon.ts';
import { createLibrary } from '../../features/library/library.ts';
import { createLastPoses } from '../../robot/lastPoses.ts';
import { createMacroRun, createMacros } from '../../features/buttons/macroRun.ts';
import { createMappings } from '../../features/inputs/mappings.ts';
import { createMotionTape } from '../../features/animate/play/motionTape.ts';
import { createNotices } from '../../state/notices.ts';
import { createPad, type Gamepadlike } from '../../features/inputs/pad.ts';
import { createPeople, PeopleError, type PeopleApi } from '../../features/people/people.ts';
import { createPlayback, createPlayhead } from '../../features/animate/play/playback.ts';
import { createPoses } from '../../features/poses/poses.ts';
import { createTeaching } from '../../features/drive/teaching.ts';
import { createRobotSync } from '../../features/profiles/robotSync.ts';
import { createRobots } from '../../features/profiles/robots.ts';
import { createGroupPlace } from '../../features/board/slots/groupPlace.ts';
import { createReplacing } from '../../features/board/slots/replacing.ts';
import { createSlots } from '../../features/board/slots/slots.ts';
import type { Stores } from '../../features/stores.ts';
import { createTimeline } from '../../features/animate/timeline/timeline.ts';
import { createView } from '../../features/view.ts';

const none = () => Promise.reject(new PeopleError('unreachable', ''));
const NOBODY: PeopleApi = {
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
  const compiled = createCompiled({ document, device, robots, clock: pageClock });
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
    people: createPeople({ api: NOBODY, me: null, notices, now: pageClock.now }),
    ...{ compiled, slots, place, replacing, playhead },
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
