// The page's stores with nothing in them and nothing behind them, for one specimen.

import type { Keeper } from '#shared/files/keeper.ts';
import type { Family } from '#shared/codec/families.ts';
import { pageClock } from '../connect/page.ts';
import { createMemoryKeeper } from '../keepers/memoryKeeper.ts';
import { createBattery } from '../stores/battery/battery.ts';
import { createBlend } from '../stores/driving/blend.ts';
import { createBoards } from '../stores/device/boards.ts';
import { createCompiled } from '../stores/group/compiled.ts';
import { createDevice } from '../stores/device/device.ts';
import { createDocument } from '../stores/group/document.ts';
import type { TextStorage } from '../stores/textStorage.ts';
import { createLibrary } from '../stores/library/library.ts';
import { createLastPoses } from '../stores/device/lastPoses.ts';
import { createMacroRun } from '../stores/driving/macroRun.ts';
import { createMacros } from '../stores/robots/macros.ts';
import { createMappings } from '../stores/robots/mappings.ts';
import { createMotionTape } from '../stores/playing/motionTape.ts';
import { createNotices } from '../stores/notices.ts';
import { createPad, type Gamepadlike } from '../stores/driving/pad.ts';
import { createPeople, PeopleError, type PeopleApi } from '../stores/people/people.ts';
import { createPlayback } from '../stores/playing/playback.ts';
import { createPlayhead } from '../stores/playing/playhead.ts';
import { createPoses } from '../stores/driving/poses.ts';
import { createTeaching } from '../stores/driving/teaching.ts';
import { createRobotKeeping } from '../stores/robots/robotKeeping.ts';
import { createRobots } from '../stores/robots/robots.ts';
import { createGroupPlace } from '../stores/slots/groupPlace.ts';
import { createReplacing } from '../stores/slots/replacing.ts';
import { createSlots } from '../stores/slots/slots.ts';
import type { Stores } from '../stores/stores.ts';
import { createTimeline } from '../stores/timeline/timeline.ts';
import { createView } from '../stores/view.ts';

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
  libraryPlace: Keeper['place'] = 'browser',
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
  const kept = {
    ...{ storage: NO_STORAGE, notices, robots, clock: pageClock },
    keeper: Promise.resolve(createMemoryKeeper(libraryPlace)),
    epochMs: Date.now,
    newId: () => `specimen-${++ids}`,
  };
  const library = createLibrary({ ...kept, document, view });
  const place = createGroupPlace({ document, opened: library.store, view, slots, device });
  const replacing = createReplacing({ device, robots, slots, place });
  const macros = createMacros(NO_STORAGE, notices, robots);
  const keeping = createRobotKeeping({
    ...{ ...kept, poses: poses.book, buttons: macros, pad: mappings, mayWrite: true },
  });
  return {
    ...{ notices, robots, device, poses, mappings, document, view, library, keeping },
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
