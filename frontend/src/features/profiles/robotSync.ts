// Synchronises this page's robots with the library: local changes are saved there, changes of other people are loaded, and a conflict
// keeps both versions. Unsaved changes wait in the browser's storage. Robots without a description are not stored. Moves nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import { type RobotFacts, robotFactsOf } from '#shared/files/facts.ts';
import {
  asLibraryError,
  LibraryError,
  listedOf,
  type DocumentStore,
  type Listed,
} from '#shared/files/documentStore.ts';
import type { MacroPage } from '#shared/profile/macro.ts';
import type { Mapping } from '#shared/profile/mapping.ts';
import type { PoseBook } from '#shared/profile/pose.ts';
import {
  kitFromText,
  kitToText,
  mergedKits,
  sameKit,
  type Kit,
  robotFromText,
  robotToText,
} from '#shared/profile/robotText.ts';
import { libraryProblem, longerName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import { type TextStorage, createThrottle } from '../../state/storage.ts';
import { loadKnown, saveKnown, type Known, type RobotDocument } from './robotDocument.ts';
import type { Notices } from '../../state/notices.ts';
import { isUsual, type OwnRobot, type RobotStore } from './robots.ts';

export interface RobotSync {
  /** Where the robots are stored; null until that is known. A new object after each listing. */
  readonly store: StoreApi<{ readonly place: DocumentStore['place'] | null }>;
  /** Loads changes of other people. */
  refresh(): void;
  /** The local id of a document in the library; null if it is not loaded yet. */
  robotOf(document: string): number | null;
  /** The document in the library once the robot is completely saved; null if that fails. */
  keep(id: number): Promise<string | null>;
}

export interface RobotSyncOptions {
  readonly documentStore: Promise<DocumentStore>;
  /** False in a viewer's browser, which only reads. */
  readonly mayWrite: boolean;
  readonly robots: RobotStore;
  readonly poses: RobotDocument<PoseBook>;
  readonly buttons: RobotDocument<MacroPage>;
  readonly pad: RobotDocument<Mapping>;
  readonly storage: TextStorage;
  readonly notices: Notices;
  readonly clock: Clock;
  /** Milliseconds since 1970. */
  epochMs(): number;
  newId(): string;
}

type There = ReadonlyMap<string, Listed<RobotFacts>>;

const isThereAs = ({ document, kit }: Known, now: Kit, there: There): boolean =>
  there.has(document) && sameKit(kit, now);

const SOON_MS = 100;
const RETRY_MS = 5000;

export function createRobotSync(options: RobotSyncOptions): RobotSync {
  const { robots, poses, buttons, pad, notices, clock, newId } = options;
  const parts = { poses, buttons, pad };
  const known = loadKnown(options.storage);
  const store = createStore<{ readonly place: DocumentStore['place'] | null }>(() => ({ place: null }));
  /** Robots without a description that must be saved, because one of them is on the board. */
  const wanted = new Set<number>();
  let turn = Promise.resolve(true);
  let hasFailed = false;
  let isTaking = false;
  let cancelRetry = (): void => undefined;

  const own = (): readonly OwnRobot[] => robots.store.getState().present.own;
  const robotAt = (id: number): OwnRobot | undefined => own().find((one) => one.id === id);

  function robotOf(document: string): number | null {
    const found = [...known].find(([id, one]) => one.document === document && robotAt(id) !== undefined);
    return found?.[0] ?? null;
  }

  function kitOf(one: OwnRobot): Kit {
    const { robot } = one;
    return {
      robot: robotToText(robot),
      ...{ poses: poses.textOf(one), buttons: buttons.textOf(one), pad: pad.textOf(one) },
    };
  }

  function isUntouched(one: OwnRobot): boolean {
    const kit = kitOf(one);
    return !known.has(one.id) && isUsual(one.robot) && !(kit.poses ?? kit.buttons ?? kit.pad);
  }

  function remember(id: number, now: Known | null): void {
    if (now === null) known.delete(id);
    else known.set(id, now);
    saveKnown(options.storage, known);
  }

  /** null if this version cannot read it. */
  function take(id: number | null, kit: Kit): number | null {
    const read = robotFromText(kit.robot);
    if ('problem' in read) return null;
    isTaking = true;
    const before = id === null ? null : robotAt(id);
    const isNews = before === null || before === undefined || robotToText(before.robot) !== kit.robot;
    const taken = isNews ? robots.takeIn(id, read.robot) : before.id;
    const one = { id: taken, robot: read.robot };
    for (const name of ['poses', 'buttons', 'pad'] as const) parts[name].takeIn(one, kit[name]);
    isTaking = false;
    return taken;
  }

  /** The local robot that a new one replaces: one without a description. */
  function placeFor(listed: Listed<RobotFacts>): number | null {
    const free = own().find((one) => isUntouched(one) && one.robot.board === listed.facts.board);
    return free?.id ?? null;
  }

  async function meet(documentStore: DocumentStore, listed: Listed<RobotFacts>): Promise<void> {
    const { id: document, revision } = listed;
    const id = [...known].find(([, one]) => one.document === document)?.[0] ?? null;
    if (listed.isRemoved) {
      if (id !== null) removedThere(id, revision);
      return;
    }
    if (id !== null && known.get(id)?.revision === revision) return;
    const stored = await documentStore.read(document);
    const theirs = kitFromText(stored.text);
    if (theirs === null) return;
    const taken =
      id !== null && robotAt(id) !== undefined ? merge(id, theirs) : take(placeFor(listed), theirs);
    if (id !== null && id !== taken) remember(id, null);
    if (taken !== null) remember(taken, { document, revision: stored.revision, kit: theirs });
  }

  /** Local changes made meanwhile stay: they are merged, or become another robot. */
  function removedThere(id: number, revision: number): void {
    const one = robotAt(id);
    const before = known.get(id);
    const isChanged = one !== undefined && before !== undefined && !sameKit(before.kit, kitOf(one));
    if (isChanged && before.revision === revision) return;
    remember(id, null);
    if (one !== undefined && !isChanged) robots.drop(id);
  }

  function merge(id: number, theirs: Kit): number | null {
    const one = robotAt(id);
    const before = known.get(id);
    if (one === undefined || before === undefined) return null;
    const ours = kitOf(one);
    const merged = mergedKits(before.kit, ours, theirs);
    if (merged === null) keepBoth(one, ours);
    return take(id, merged ?? theirs);
  }

  /** The newer robot keeps its document; ours becomes another robot. */
  function keepBoth({ robot }: OwnRobot, ours: Kit): void {
    const name = longerName(robot.name, words.robots.otherVersion);
    take(null, { ...ours, robot: robotToText({ ...robot, name }) });
    notices.show('warning', words.robots.conflict({ name: robot.name, copy: name }));
  }

  /** False after a conflict, which must be resolved first. */
  async function bring(documentStore: DocumentStore, one: OwnRobot, there: There): Promise<boolean> {
    const before = known.get(one.id);
    const kit = kitOf(one);
    if (before === undefined ? isUntouched(one) && !wanted.has(one.id) : isThereAs(before, kit, there))
      return true;
    const { document, revision: expected } = before ?? placeOf(one, there);
    const facts = robotFactsOf(one.robot, poses.of(one), options.epochMs());
    const writing = { text: kitToText(kit), facts, expected, isRemoved: false };
    try {
      remember(one.id, { document, revision: await documentStore.write(document, writing), kit });
      return true;
    } catch (error) {
      if (error instanceof LibraryError && error.code === 'conflict') return false;
      throw error;
    }
  }

  /** The usual robot of a board has the same document wherever it was made, also in the trash. */
  function placeOf(one: OwnRobot, there: There): Pick<Known, 'document' | 'revision'> {
    const usual = `usual-${one.robot.board}`;
    const trashed = there.get(usual);
    if (!isUntouched(one) || trashed?.isRemoved === false) return { document: newId(), revision: 0 };
    return { document: usual, revision: trashed?.revision ?? 0 };
  }

  /** A refused robot does not block the others. */
  async function bringAll(documentStore: DocumentStore, there: There): Promise<boolean> {
    const failures: unknown[] = [];
    const added: string[] = [];
    let isWhole = true;
    for (const one of own()) {
      const isNew = !known.has(one.id) && !isUntouched(one);
      const isSaved = await bring(documentStore, one, there).catch((error: unknown) => {
        failures.push(error);
        return true;
      });
      isWhole &&= isSaved;
      if (isNew && known.has(one.id)) added.push(one.robot.name);
    }
    if (added.length > 0 && store.getState().place === null && documentStore.place === 'gateway')
      notices.show('info', words.robots.addedToLibrary({ names: words.numbers.formatNames(added) }));
    await removeGone(documentStore);
    if (failures.length > 0) throw failures[0];
    return isWhole;
  }

  async function removeGone(documentStore: DocumentStore): Promise<void> {
    for (const [id, { document }] of known) {
      if (robotAt(id) !== undefined) continue;
      // If this is refused, the robot comes back.
      remember(id, null);
      await documentStore.remove([document]);
    }
  }

  /** At the start of a visit: robots without a description, if there are others. */
  function tidy(): void {
    if (store.getState().place !== null) return;
    const { currentId } = robots.store.getState().present;
    for (const one of own())
      if (one.id !== currentId && isUntouched(one) && known.size > 0) robots.drop(one.id);
  }

  async function look(): Promise<void> {
    const documentStore = await options.documentStore;
    for (let isWhole = false; !isWhole;) {
      const listed = listedOf(await documentStore.list(), 'robot');
      for (const one of listed) await meet(documentStore, one);
      const there: There = new Map(listed.map((one) => [one.id, one]));
      isWhole = !options.mayWrite || (await bringAll(documentStore, there));
    }
    tidy();
    store.setState({ place: documentStore.place }, true);
  }

  /** Called repeatedly: a document store that stays away is reported once. */
  async function attempt(): Promise<boolean> {
    try {
      await look();
      hasFailed = false;
    } catch (error) {
      if (!hasFailed) tell(error);
      hasFailed = true;
      cancelRetry();
      cancelRetry = clock.after(RETRY_MS, refresh);
    }
    return !hasFailed;
  }

  function tell(error: unknown): void {
    const { code, message } = asLibraryError(error);
    const text =
      code === 'tooLarge'
        ? words.robots.tooLarge
        : words.robots.notInLibrary({ problem: libraryProblem(code, message) });
    notices.show('warning', text);
  }

  const lookNow = (): Promise<boolean> => (turn = turn.then(attempt));
  const soon = createThrottle(clock, SOON_MS, () => void lookNow());
  const refresh = (): void => soon.request();
  const changed = (): void => {
    if (!isTaking) soon.request();
  };

  robots.store.subscribe(({ present }, before) => {
    if (present.own !== before.present.own) changed();
  });
  for (const document of [poses, buttons, pad]) document.onChange(changed);
  void lookNow();

  return {
    store,
    refresh,
    robotOf,
    async keep(id) {
      wanted.add(id);
      const isSaved = await lookNow();
      return isSaved ? (known.get(id)?.document ?? null) : null;
    },
  };
}
