// Builds the page's stores with the browser's own clock and storage, and starts the first link.

import type { Clock } from '#shared/clock.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { createCollisions } from '../features/board/compile/collisions.ts';
import { createCompileWorker, createCompiled } from '../features/board/compile/compiled.ts';
import { createBattery, pollBattery, applyBatteryPolicy } from '../features/battery/battery.ts';
import { createBlend, createPoses } from '../features/poses/poses.ts';
import { createBoards, createLastPoses } from '../robot/remembered.ts';
import { createDevice } from '../robot/device.ts';
import { createDocument } from '../features/groupDocument.ts';
import { readText, saveText, storageOf, type TextStorage } from '../state/storage.ts';
import type { DocumentStore } from '#shared/files/documentStore.ts';
import { followLanguage, createView } from '../features/view.ts';
import { createLibrary } from '../features/library/library.ts';
import { createMacroRun, createMacros } from '../features/buttons/macroRun.ts';
import { createMappings, createPad, watchInputs } from '../features/inputs/pad.ts';
import { createGroupPlace } from '../features/board/slots/groupPlace.ts';
import { createMotionTape } from '../features/animate/play/motionTape.ts';
import { createNotices } from '../state/notices.ts';
import { createPeople, peopleProblem, peopleApi } from '../features/people/people.ts';
import type { Me } from '#shared/client/http.generated.ts';
import { createPlayback, createPlayhead } from '../features/animate/play/playback.ts';
import { endRecordingWithStop } from '../features/animate/play/TakeDialog.tsx';
import { createTeaching } from '../features/drive/teaching.ts';
import { createRobotSync } from '../features/profiles/robotSync.ts';
import { followRobot } from '../features/profiles/robotOfLink.ts';
import { createRobots } from '../features/profiles/robots.ts';
import { createReplacing } from '../features/board/slots/replacing.ts';
import { createSlots } from '../features/board/slots/slots.ts';
import type { Stores } from '../features/stores.ts';
import {
  createTimeline,
  resetForOpenedGroup,
  restoreSelection,
} from '../features/animate/timeline/timeline.ts';
import { browserClock } from '../robot/links/browserClock.ts';
import { hasGateway, putOnBoard } from '../robot/gatewayApi.ts';
import { beginAnewAsAnother, type Arrival, watchLeaving } from './arrival.ts';
import { createConnector, type Connector } from '../robot/connector.ts';

const VISITED_KEY = 'servodeck.visited';

/** The page's time, for everything but transports. */
export const pageClock: Clock = browserClock;

export interface Page {
  readonly stores: Stores;
  readonly connector: Connector;
}

/** `arrival` says who is here; a page without a gateway belongs to the person who opens it. */
export async function openPage({ me, problem }: Arrival): Promise<Page> {
  const storage = storageOf(() => window.localStorage);
  const notices = createNotices(pageClock);
  const view = createView({ browser: storage, tab: storageOf(() => window.sessionStorage) });
  // Documents begin with names in the language of the person who opens the page.
  await followLanguage({ view, notices, tags: navigator.languages });
  const robots = createRobots(storage, notices);
  const device = createDevice({
    family: FAMILIES[robots.current().robot.board],
    clock: pageClock,
    notices,
    robots,
  });
  const boards = createBoards(storage);
  const battery = createBattery(device, robots);
  const mappings = createMappings(storage, notices, robots);
  const readPads = () => (isSecureContext ? navigator.getGamepads() : []);
  const poses = createPoses({ storage, notices, robots, device, view });
  const pad = createPad({ device, robots, view, poses, mappings, notices, clock: pageClock, readPads });
  const macros = createMacros(storage, notices, robots);
  const macroRun = createMacroRun({ device, poses, robots, notices, clock: pageClock });
  const written = createDocument(storage, notices, pageClock);
  const documentStore = chooseStore(me);
  const library = createLibrary({
    ...{ document: written, storage, notices, robots, view, clock: pageClock },
    ...{ documentStore, epochMs: Date.now, newId },
  });
  const mayWrite = me?.you?.role !== 'viewer';
  const robotSync = createRobotSync({
    ...{ robots, poses: poses.book, buttons: macros, pad: mappings, storage, notices, clock: pageClock },
    ...{ documentStore: mayWrite ? documentStore : loadGatewayStore(), mayWrite, epochMs: Date.now, newId },
  });
  const noteRobot = followRobot({ robots, robotSync, notices, clock: pageClock, mayWrite, putOnBoard });
  device.store.subscribe(({ snapshot }, before) => {
    if (snapshot !== before.snapshot) noteRobot(snapshot);
  });
  const compiled = createCompiled({
    ...{ document: written, device, robots, clock: pageClock },
    compileElsewhere: createCompileWorker(),
  });
  const collisions = createCollisions(compiled, async () =>
    (await import('../features/board/compile/checkInWorker.ts')).createCheck(),
  );
  const slots = createSlots({ device, robots, notices, storage, today: Date.now });
  const place = createGroupPlace({ document: written, opened: library.store, view, slots, device });
  const replacing = createReplacing({ device, robots, slots, place });
  const timeline = createTimeline();
  const playhead = createPlayhead(timeline);
  const playback = createPlayback({
    ...{ device, document: written, compiled, slots, place, replacing, notices, view, playhead, robots },
    documentId: () => library.store.getState().openId,
  });
  const stores = {
    ...{ device, notices, boards, robots, battery, mappings, pad, poses, macroRun, library, view },
    ...{ compiled, collisions, slots, place, replacing, playhead, playback, robotSync },
    blend: createBlend({ device, robots, view }),
    teaching: createTeaching({ device, robots, notices }),
    people: createPeople({ api: peopleApi, me, notices, now: pageClock.now }),
    tape: createMotionTape({ device, robots, clock: pageClock }),
    macros,
    document: written,
    lastPoses: createLastPoses(storage, device),
    timeline,
  };
  const connector = createConnector({
    device,
    notices,
    boards,
    storage,
    isWatched,
    role: me?.you?.role ?? 'owner',
    isAtGateway: me !== null,
    describeRobot: (body, board) =>
      void import('../features/connect/RobotQuestion.tsx').then(
        ({ takeUpKind }) => takeUpKind(robots, body, board),
        notices.showError,
      ),
  });
  if (problem !== null) notices.show('warning', peopleProblem(problem.code, problem.message));
  if (me?.you) beginAnewAsAnother(device.store, me.you, () => location.reload());
  connector.start().catch(notices.showError);
  const paused = (): void => {
    playback.hidden();
    macroRun.end();
    written.flush();
  };
  const left = (): void => {
    connector.leave();
    written.flush();
  };
  watchLeaving(window, { hidden: paused, left });
  endRecordingWithStop(stores);
  applyBatteryPolicy({ device, battery, robots, poses, notices });
  void welcomeVisitor(storage, { device, robots });
  watchInputs(window, pad);
  resetForOpenedGroup({ library, view, timeline });
  restoreSelection({ document: written, timeline, view });
  void import('../features/board/slots/othersGroups.ts').then(
    ({ findOthersGroups }) => findOthersGroups({ device, robots, slots, compiled, library, documentStore }),
    notices.showError,
  );
  stores.view.subscribe(({ tab, kiosk }) => {
    if (tab === 'buttons' || kiosk === 'on') pad.drive(null);
  });
  pollBattery(device, isWatched);
  window.addEventListener('focus', () => {
    void library.refresh();
    robotSync.refresh();
  });
  return { stores, connector };
}

/** The gateway's, where there is one to write to: what a viewer tries out stays in the viewer's browser. */
async function chooseStore(me: Me | null): Promise<DocumentStore> {
  const isViewer = me?.you?.role === 'viewer';
  const isSaved = !isViewer && (me !== null || (await hasGateway(pageClock)));
  if (isSaved) return loadGatewayStore();
  const { createBrowserStore } = await import('../features/library/browserStore.ts');
  return createBrowserStore('servodeck', Date.now);
}

/** Which of them is wanted is known only later: neither is in the first load. */
const loadGatewayStore = async (): Promise<DocumentStore> =>
  (await import('../features/library/gatewayStore.ts')).gatewayStore;

const TOUCHES = ['pointerdown', 'keydown', 'wheel'] as const;

/** The visit counts once it is touched, also before the part that welcomes has come. */
async function welcomeVisitor(
  storage: TextStorage,
  stores: Pick<Stores, 'device' | 'robots'>,
): Promise<void> {
  const isFirstVisit = readText(storage, VISITED_KEY) === null;
  const touched = new AbortController();
  const { signal } = touched;
  signal.addEventListener('abort', () => saveText(storage, VISITED_KEY, 'yes'));
  for (const touch of TOUCHES)
    window.addEventListener(touch, () => touched.abort(), { capture: true, signal });
  const { welcome } = await import('./welcome.ts');
  welcome({ ...stores, clock: pageClock, isFirstVisit, touched: signal, isWatched });
}

/** Not `randomUUID`, which is there only at secure addresses. */
function newId(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return [...bytes].map((byte) => byte.toString(16).padStart(2, '0')).join('');
}

const isWatched = (): boolean => document.visibilityState === 'visible';
