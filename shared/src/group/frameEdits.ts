// Edits of whole frames that leave their times alone (note, colour, left and right), of markers, and a whole group in the other
// unit. Pure functions, the very same object where nothing changes. What left and right is, the robot profile says.

import { rescaled } from '../profile/units.ts';
import type { Colour } from '../document/schema.ts';
import { mirroredTargets } from '../profile/poseShapes.ts';
import type { Robot, RobotServo } from '../profile/robot.ts';
import { MOST_ERROR_UNITS, type ActionGroup, type GroupFrame, type KeyTarget, type Marker } from './group.ts';
import { changed, sameList, samePose } from './groupEdits.ts';
import { wholeMs } from './moments.ts';

export function setNote(group: ActionGroup, frameId: number, note: string): ActionGroup {
  return changeFrames(group, [frameId], (frame) => changed(frame, { note }));
}

export function setColour(
  group: ActionGroup,
  frameIds: readonly number[],
  colour: Colour | null,
): ActionGroup {
  return changeFrames(group, frameIds, (frame) => changed(frame, { colour }));
}

interface Mirrored {
  readonly group: ActionGroup;
  /** Servos that would have had to go beyond their limits, and now stand at them. */
  readonly held: readonly RobotServo[];
}

/** What one side does in these frames, the other does. */
export function mirror(group: ActionGroup, robot: Robot, frameIds: readonly number[]): Mirrored {
  const held = new Set<RobotServo>();
  const mirrored = changeFrames(group, frameIds, (frame) => {
    const shape = mirroredTargets(robot, frame.targets);
    for (const servo of shape.held) held.add(servo);
    return samePose(frame.targets, shape.targets) ? frame : { ...frame, targets: shape.targets };
  });
  return { group: mirrored, held: [...held] };
}

function changeFrames(
  group: ActionGroup,
  frameIds: readonly number[],
  change: (frame: GroupFrame) => GroupFrame,
): ActionGroup {
  const chosen = new Set(frameIds);
  const frames = group.frames.map((frame) => (chosen.has(frame.id) ? change(frame) : frame));
  return changed(group, { frames: sameList(group.frames, frames) });
}

// Edits of a group's markers, as pure functions, the very same object where nothing changes.

export function addMarker(group: ActionGroup, atMs: number, text: string): ActionGroup {
  const marker: Marker = { id: group.nextId, atMs: wholeMs(atMs), text };
  return { ...group, nextId: group.nextId + 1, markers: [...group.markers, marker] };
}

export function moveMarker(group: ActionGroup, id: number, atMs: number): ActionGroup {
  return changeMarker(group, id, { atMs: wholeMs(atMs) });
}

export function renameMarker(group: ActionGroup, id: number, text: string): ActionGroup {
  return changeMarker(group, id, { text });
}

export function deleteMarker(group: ActionGroup, id: number): ActionGroup {
  return withMarkers(
    group,
    group.markers.filter((marker) => marker.id !== id),
  );
}

function changeMarker(group: ActionGroup, id: number, change: Partial<Marker>): ActionGroup {
  return withMarkers(
    group,
    group.markers.map((marker) => (marker.id === id ? changed(marker, change) : marker)),
  );
}

function withMarkers(group: ActionGroup, markers: readonly Marker[]): ActionGroup {
  return changed(group, { markers: sameList(group.markers, markers) });
}

// Converting keeps looks: a group holds no ranges of the robot it was made for, so angles would have no beginning.

/** To the nearest unit; null where a pulse is shorter than any step. The same group where it counts so already. */
export function convertGroup(group: ActionGroup, unit: ActionGroup['unit']): ActionGroup | null {
  if (group.unit === unit) return group;
  const at = (position: number): number => Math.round(rescaled(position, group.unit, unit));
  const keyed = [...group.frames, ...(group.blocks ?? []).flatMap(({ moments }) => moments)];
  const isTooLow = keyed.some(({ targets }) => targets.some(({ position }) => at(position) < 0));
  if (isTooLow) return null;
  const { maxErrorUnits } = group;
  const per = Math.abs(rescaled(1, group.unit, unit) - rescaled(0, group.unit, unit));
  const converted = <T extends { readonly targets: readonly KeyTarget[] }>(one: T): T => ({
    ...one,
    targets: one.targets.map((target) => ({ ...target, position: at(target.position) })),
  });
  const frames = group.frames.map(converted);
  const blocks = group.blocks?.map((block) => ({ ...block, moments: block.moments.map(converted) }));
  return {
    ...group,
    ...{ unit, frames },
    ...(blocks && { blocks }),
    ...(maxErrorUnits !== undefined && {
      maxErrorUnits: Math.min(MOST_ERROR_UNITS, Math.max(1, Math.round(maxErrorUnits * per))),
    }),
  };
}
