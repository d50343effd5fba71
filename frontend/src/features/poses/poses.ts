// The poses of the current robot: capturing one, moving to one within the limits, slowly by default, and the blend of two, which the robot
// can follow until STOP. A move to a pose is an undo step of the book of poses; undoing it changes the book and moves nothing.

import type { Label } from '#shared/document/history.ts';
import {
  EMPTY_BOOK,
  addPose,
  poseOf,
  type PoseBook,
  type PoseRef,
  markApplied,
  withPosesOf,
  poseBookFromText,
  poseBookToText,
} from '#shared/profile/pose.ts';
import { homeTargets, unknownServos } from '#shared/profile/poseShapes.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { flawSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { Device } from '../../robot/device.ts';
import { limitRefusal } from '../../robot/moves.ts';
import { freeOf, stayingOf, type Locking } from '../servoView.ts';
import type { Notices } from '../../state/notices.ts';
import { createRobotDocument, type RobotDocument } from '../profiles/robotDocument.ts';
import type { RobotStore } from '../profiles/robots.ts';
import type { TextStorage } from '../../state/storage.ts';
import type { View } from '../view.ts';
import { createStore, type StoreApi } from 'zustand/vanilla';
import { endsMotion } from '../../robot/readiness.ts';
import { createFollower } from '../../robot/follower.ts';

export interface Poses {
  readonly book: RobotDocument<PoseBook>;
  /** null if the pose does not exist or has another unit than the board. */
  targetsOf(ref: PoseRef): readonly ServoTarget[] | null;
  /** Adds and selects a pose with the current targets; moves nothing. Returns its name. */
  capture(): string;
  /** False if it was refused; then a notice says why. */
  apply(ref: PoseRef, durationMs: number): boolean;
  /** Moves to a blend of two poses. */
  applyBlend(label: Label, targets: readonly ServoTarget[], durationMs: number): void;
  /** Adds the poses of a file, all or none. */
  importText(text: string): void;
}

export interface PosesOptions {
  readonly storage: TextStorage;
  readonly notices: Notices;
  readonly robots: RobotStore;
  readonly device: Device;
  readonly view: View;
}

export function createPoses({ storage, notices, robots, device, view }: PosesOptions): Poses {
  const book = createRobotDocument({
    ...{
      storage,
      notices,
      robots,
      key: 'servodeck.poses',
      notSaved: () => words.poses.notSaved,
      unreadable: (flaw) => words.poses.unreadable({ flaw: flawSentence(flaw) }),
    },
    ...{ fresh: () => EMPTY_BOOK, toText: poseBookToText, fromText: poseBookFromText },
    shared: { of: withoutPlace, onto: onPlaceOf },
  });
  const present = (): PoseBook => book.store.getState().present;

  function targetsOf(ref: PoseRef): readonly ServoTarget[] | null {
    const id = ref === 'rest' ? present().restId : ref;
    if (id === 'home' || id === null) return homeTargets(robots.current().robot);
    const pose = poseOf(present(), id);
    return pose?.unit === device.store.getState().family.unit ? pose.targets : null;
  }

  /** Locked servos stay; a notice names them. */
  function go(targets: readonly ServoTarget[], durationMs: number): boolean {
    const staying = stayingOf({ view, robots }, targets);
    const free = freeOf({ view, robots }, targets);
    const isGone = free.length > 0 && device.move(free, durationMs);
    if (staying !== null && (isGone || free.length === 0)) notices.show('info', staying);
    return isGone;
  }

  /** Checks all poses together, because a file is imported completely or not at all. */
  function flawOfImport({ poses }: PoseBook): string | null {
    return limitRefusal(
      robots.current().robot,
      poses.flatMap(({ targets }) => targets),
    );
  }

  function take(imported: PoseBook): void {
    book.edit(
      () => words.poses.steps.import,
      (before) => withPosesOf(before, imported),
    );
    const targets = imported.poses.flatMap((pose) => pose.targets);
    const unknown = unknownServos(robots.current().robot, targets);
    if (unknown.length > 0)
      notices.show('warning', words.poses.unknownServos({ servos: words.numbers.formatList(unknown) }));
  }

  return {
    book,
    targetsOf,
    capture() {
      const { nextId } = present();
      const { unit } = device.store.getState().family;
      const pose = { name: words.poses.newName({ number: nextId }), unit, targets: device.pose() };
      book.edit(
        () => words.poses.steps.capture({ name: pose.name }),
        (before) => addPose(before, pose),
      );
      view.setState({ selectedPose: nextId });
      return pose.name;
    },
    apply(ref, durationMs) {
      const targets = targetsOf(ref);
      if (targets === null) notices.show('warning', words.poses.gone);
      if (targets === null || !go(targets, durationMs)) return false;
      const name = poseName(present(), ref);
      book.edit(
        () => words.poses.steps.apply({ name }),
        (before) => markApplied(before, ref),
      );
      return true;
    },
    applyBlend(label, targets, durationMs) {
      if (go(targets, durationMs)) book.edit(label, (before) => markApplied(before, null));
    },
    importText(text) {
      const read = poseBookFromText(text);
      const problem =
        'problem' in read
          ? words.poses.importFailed({ flaw: flawSentence(read.problem) })
          : flawOfImport(read.value);
      if (problem !== null) notices.show('warning', problem);
      else if ('value' in read) take(read.value);
    },
  };
}

/** Without the last applied pose, which belongs to the robot and not to the book. */
const withoutPlace = (book: PoseBook): PoseBook => ({ ...book, applied: null });

function onPlaceOf({ applied }: PoseBook, book: PoseBook): PoseBook {
  return typeof applied === 'number' && poseOf(book, applied) === undefined ? book : { ...book, applied };
}

export function poseName(book: PoseBook, ref: PoseRef): string {
  if (typeof ref === 'string') return words.poses.verbs[ref];
  return poseOf(book, ref)?.name ?? words.poses.missing;
}

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
