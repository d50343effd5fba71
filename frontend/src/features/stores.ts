// All stores of the page as one bundle in a React context, and the hooks that read them. A panel subscribes to exactly the values it
// shows.

import { createContext, use } from 'react';
import { useStore } from 'zustand';
import { familyOfUnit, robotInUnit } from '#shared/profile/units.ts';
import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import type { Family } from '#shared/codec/families.ts';
import { holdsMotion, type ActionGroup } from '#shared/group/group.ts';
import type { History } from '#shared/document/history.ts';
import type { MacroPage } from '#shared/profile/macro.ts';
import type { PoseBook } from '#shared/profile/pose.ts';
import type { BatteryState, BatteryStore } from './battery/battery.ts';
import type { Blend, BlendState, Poses } from './poses/poses.ts';
import { type Boards, guessesOf, guessOf, type LastPoses, type Positions } from '../robot/remembered.ts';
import type { CollisionState, CollisionStore } from './board/compile/collisions.ts';
import type { CompiledState, CompiledStore } from './board/compile/compiled.ts';
import type { MotionTape } from './animate/play/motionTape.ts';
import type { Mapping } from '#shared/profile/mapping.ts';
import type { Device, DeviceState } from '../robot/device.ts';
import {
  type Document,
  type DocumentState,
  boardOfGroup,
  knownFamily,
  type GroupBoard,
} from './groupDocument.ts';
import { currentOf, type RobotStore } from './profiles/robots.ts';
import type { RobotSync } from './profiles/robotSync.ts';
import type { Notices } from '../state/notices.ts';
import { servoViewFor, type ServoView } from './servoView.ts';
import type { Pad, PadState } from './inputs/pad.ts';
import type { MacroRun } from './buttons/macroRun.ts';
import type { Playback, PlaybackState, Playhead } from './animate/play/playback.ts';
import type { PeopleStore } from './people/people.ts';
import type { Teaching } from './drive/teaching.ts';
import type { GroupPlace } from './board/slots/groupPlace.ts';
import type { Replacing } from './board/slots/replacing.ts';
import type { Slots, SlotsState } from './board/slots/slots.ts';
import type { Undoable } from '../state/store.ts';
import type { Library, LibraryState } from './library/library.ts';
import type { Timeline, TimelineState } from './animate/timeline/timeline.ts';
import type { View, ViewState } from './view.ts';
import { timesOf } from '#shared/group/groupTimes.ts';

export interface Stores {
  readonly device: Device;
  readonly document: Document;
  readonly library: Library;
  readonly view: View;
  readonly timeline: Timeline;
  readonly notices: Notices;
  readonly boards: Boards;
  readonly lastPoses: LastPoses;
  readonly robots: RobotStore;
  readonly robotSync: RobotSync;
  readonly battery: BatteryStore;
  readonly mappings: Undoable<Mapping>;
  readonly pad: Pad;
  readonly poses: Poses;
  readonly blend: Blend;
  readonly teaching: Teaching;
  readonly people: PeopleStore;
  readonly macros: Undoable<MacroPage>;
  readonly macroRun: MacroRun;
  readonly compiled: CompiledStore;
  readonly collisions: CollisionStore;
  readonly slots: Slots;
  readonly place: GroupPlace;
  readonly replacing: Replacing;
  readonly playhead: Playhead;
  readonly playback: Playback;
  readonly tape: MotionTape;
}

export const StoresContext = createContext<Stores | null>(null);

export function useStores(): Stores {
  const stores = use(StoresContext);
  if (stores === null) throw new Error('a panel stands outside StoresContext');
  return stores;
}

export function useDevice<T>(select: (state: DeviceState) => T): T {
  return useStore(useStores().device.store, select);
}

export function useSnapshot<T>(select: (snapshot: DeviceState['snapshot']) => T): T {
  return useStore(useStores().device.store, (state) => select(state.snapshot));
}

export function useDocument<T>(select: (state: DocumentState) => T): T {
  return useStore(useStores().document.store, select);
}

export function useGroup(): ActionGroup {
  return useDocument((state) => state.present);
}

/** As controls ask it: only changes between empty and not draw again. */
export const useHoldsMotion = (): boolean => useDocument(({ present }) => holdsMotion(present));

export function useLibrary<T>(select: (state: LibraryState) => T): T {
  return useStore(useStores().library.store, select);
}

export function usePoses<T>(select: (state: History<PoseBook>) => T): T {
  return useStore(useStores().poses.book.store, select);
}

export function useBlend<T>(select: (state: BlendState) => T): T {
  return useStore(useStores().blend.store, select);
}

/** True while the servos are posed by hand. */
export function useIsTeaching(): boolean {
  return useStore(useStores().teaching.store, ({ isOn }) => isOn);
}

export function useMacros<T>(select: (state: History<MacroPage>) => T): T {
  return useStore(useStores().macros.store, select);
}

/** The family of the connected board; while unknown, the one of the current robot. */
export function useKnownFamily(): Family {
  const robot = useRobot();
  return useDevice(({ family }) => knownFamily(family, robot));
}

/** True if the link is open and the family of the board is neither identified nor chosen. A gateway may still report it. */
export function useIsUnidentified(): boolean {
  return useDevice(
    ({ family, way, snapshot: { link } }) =>
      family.id === 'unknown' && way !== null && link.status !== 'closed' && link.status !== 'opening',
  );
}

/** The robot and board that the open group is drawn with. */
export function useGroupBoard(): GroupBoard {
  const [robot, family] = [useRobot(), useKnownFamily()];
  const unit = useDocument(({ present }) => present.unit);
  const isOther = useDocument(({ present }) => boardOfGroup(present, family, robot).isOther);
  return isOther
    ? { family: familyOfUnit(unit), robot: robotInUnit(robot, unit), isOther }
    : { family, robot, isOther };
}

export function groupBoardOf({
  document,
  device,
  robots,
}: Pick<Stores, 'document' | 'device' | 'robots'>): GroupBoard {
  const { robot } = robots.current();
  return boardOfGroup(
    document.store.getState().present,
    knownFamily(device.store.getState().family, robot),
    robot,
  );
}

/** The slot for Download and Run. */
export function useSlot(): number {
  return useStore(useStores().place.store, ({ slot }) => slot);
}

/** The current robot. */
export function useRobot(): Robot {
  return useStore(useStores().robots.store, ({ present }) => currentOf(present).robot);
}

export function useBattery<T>(select: (state: BatteryState) => T): T {
  return useStore(useStores().battery, select);
}

/** A guess of the servo's position while it is unknown. */
export function useGuess(servo: RobotServo): number | null {
  const { lastPoses } = useStores();
  // A servo with a target needs no guess.
  return useDevice((state) => guessOf(lastPoses.getState(), state, servo));
}

/** True if a guess is shown for any servo. */
export function useIsGuessing(): boolean {
  const { lastPoses } = useStores();
  const robot = useRobot();
  return useDevice((state) => Object.keys(guessesOf(lastPoses.getState(), state, robot)).length > 0);
}

export function guessNow({ lastPoses, device }: Pick<Stores, 'lastPoses' | 'device'>, servo: RobotServo) {
  return guessOf(lastPoses.getState(), device.store.getState(), servo);
}

export function guessesNow({
  lastPoses,
  device,
  robots,
}: Pick<Stores, 'lastPoses' | 'device' | 'robots'>): Positions {
  return guessesOf(lastPoses.getState(), device.store.getState(), robots.current().robot);
}

/** The mapping of pad and keys. */
export function useMapping(): Mapping {
  return useStore(useStores().mappings.store, ({ present }) => present);
}

export function usePad<T>(select: (state: PadState) => T): T {
  return useStore(useStores().pad.store, select);
}

export function useCompiled<T>(select: (state: CompiledState) => T): T {
  return useStore(useStores().compiled.store, select);
}

export function useCollisions<T>(select: (state: CollisionState) => T): T {
  return useStore(useStores().collisions, select);
}

export function useSlots<T>(select: (state: SlotsState) => T): T {
  return useStore(useStores().slots.store, select);
}

export function usePlayback<T>(select: (state: PlaybackState) => T): T {
  return useStore(useStores().playback.store, select);
}

export function useView<T>(select: (state: ViewState) => T): T {
  return useStore(useStores().view, select);
}

export function useTimeline<T>(select: (state: TimelineState) => T): T {
  return useStore(useStores().timeline, select);
}

/** The view of the current robot's servos. */
export function useServoView<T>(select: (view: ServoView) => T): T {
  const robotId = useStore(useStores().robots.store, ({ present }) => currentOf(present).id);
  return useView(({ servos }) => select(servoViewFor(servos, robotId)));
}

export function servoViewOf({ view, robots }: Pick<Stores, 'view' | 'robots'>): ServoView {
  return servoViewFor(view.getState().servos, robots.current().id);
}

export function editServoView(
  stores: Pick<Stores, 'view' | 'robots'>,
  change: (view: ServoView) => ServoView,
): void {
  const { id } = stores.robots.current();
  stores.view.setState({ servos: { ...change(servoViewOf(stores)), robotId: id } });
}

/** As an index; null while nothing is played. */
export function usePlayedFrame(): number | null {
  const { document } = useStores();
  const isPlaying = usePlayback(({ phase }) => phase !== null && phase !== 'storing');
  const index = useTimeline(({ playheadMs }) =>
    isPlaying
      ? timesOf(document.store.getState().present).ends.findIndex((endMs) => endMs >= playheadMs)
      : -1,
  );
  return index === -1 ? null : index;
}
