// A page's robots at one document store in virtual time, for tests; `texts` is its browser's storage.

import type { DocumentStore } from '#shared/files/documentStore.ts';
import { addPose } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import type { VirtualClock } from '#shared/testing/virtualClock.ts';
import { createDevice } from '../../robot/device.ts';
import { createMacros } from '../buttons/macroRun.ts';
import { createMappings } from '../inputs/pad.ts';
import { createNotices } from '../../state/notices.ts';
import { createPoses } from '../poses/poses.ts';
import { createView } from '../view.ts';
import { createRobotSync } from './robotSync.ts';
import { createRobots } from './robots.ts';

const EPOCH_MS = 1_790_000_000_000;

export function createVisit(
  documentStore: DocumentStore,
  clock: VirtualClock,
  texts = new Map<string, string>(),
  mayWrite = true,
) {
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
  const notices = createNotices(clock);
  const robots = createRobots(storage, notices);
  const device = createDevice({ family: FAMILIES.doc, clock, notices, robots });
  const { book } = createPoses({
    storage,
    notices,
    robots,
    device,
    view: createView({ browser: storage, tab: storage }),
  });
  const robotSync = createRobotSync({
    ...{
      documentStore: Promise.resolve(documentStore),
      mayWrite,
      robots,
      poses: book,
      storage,
      notices,
      clock,
    },
    buttons: createMacros(storage, notices, robots),
    pad: createMappings(storage, notices, robots),
    epochMs: () => EPOCH_MS,
    newId: nextId,
  });
  return {
    ...{ texts, robots, book, robotSync, notices },
    names: () => robots.store.getState().present.own.map(({ robot }) => robot.name),
    poses: () => book.store.getState().present.poses.map(({ name }) => name),
    noticeTexts: () => notices.store.getState().map(({ text }) => text),
    capture: (name: string) =>
      book.edit(
        () => 'capture',
        (before) => addPose(before, { name, unit: 'us', targets: [{ servo: 1, position: 1700 }] }),
      ),
  };
}

export const named =
  (name: string) =>
  (robot: Robot): Robot => ({ ...robot, name });

let ids = 0;
export const nextId = (): string => `id-${++ids}`;
