// What playing means now: which part of the group, from where, how often, and which servos hear of it. Plays nothing.

import { motionLengthMs, motionTracks } from '#shared/group/blocks.ts';
import { passageOf, type Passage, type PassageOptions } from '#shared/group/passage.ts';
import { poseAtMs } from '#shared/group/tracks.ts';
import type { Frame, ServoTarget } from '#shared/codec/commands.ts';
import type { Family } from '#shared/codec/families.ts';
import { startsKnown } from '#shared/robot/state.ts';
import { RANGE_MS } from '#shared/robot/timings.ts';
import type { CompiledGroup } from '../../board/compile/compiled.ts';
import type { Device } from '../../../robot/device.ts';
import type { Document } from '../../groupDocument.ts';
import type { FollowedPose } from '../../../robot/follower.ts';
import { chosenTimes } from '../../board/slots/groupPlace.ts';
import type { Playhead } from './playback.ts';
import type { RobotStore } from '../../profiles/robots.ts';
import { isSilent, servoViewFor } from '../../servoView.ts';
import type { View } from '../../view.ts';

export interface PlayedPart {
  /** Where the playhead is within the part to play; null: it begins at the beginning, as a loop always does. */
  within(): number | null;
  /** What was marked, or all of it. */
  part(): { readonly fromMs: number; readonly toMs: number };
  /** As often as the group is run on its board; from within it, the rest once. 0: until stopped. */
  passes(): number;
  /** What goes to the robot of it; these servos are left out. */
  passage(group: CompiledGroup, without?: readonly number[]): Passage;
  /** Of the servos that hear of it. */
  poseAt(atMs: number): FollowedPose;
}

export interface PlayedPartOptions {
  readonly device: Device;
  readonly document: Document;
  readonly view: View;
  readonly playhead: Playhead;
  readonly robots: RobotStore;
  chosen(): { readonly loops: boolean; readonly speedPercent: number };
}

/** Of a servo's range: a step of so much is not seen as a jerk. */
const LARGEST_SEAM = 0.05;

const seamOf = ({ position: { min, max } }: Family): PassageOptions['seam'] => ({
  largestStep: (max - min) * LARGEST_SEAM,
  unitsPerMs: (max - min) / RANGE_MS,
});

export function createPlayedPart(options: PlayedPartOptions): PlayedPart {
  const { device, document, view, playhead, robots, chosen } = options;

  function within(): number | null {
    const { fromMs, toMs } = part();
    const at = playhead.at();
    return at > fromMs && at < toMs && !chosen().loops ? at : null;
  }

  function part(): { readonly fromMs: number; readonly toMs: number } {
    return playhead.range() ?? { fromMs: 0, toMs: motionLengthMs(document.store.getState().present) };
  }

  function passes(): number {
    if (chosen().loops) return 0;
    return within() === null ? chosenTimes(view.getState()) : 1;
  }

  /** Rows that are muted, or beside those that play alone, are not sent. */
  function isSent({ servo }: Pick<ServoTarget, 'servo'>): boolean {
    return !isSilent(servoViewFor(view.getState().servos, robots.current().id), servo);
  }

  function passage({ frames, source }: CompiledGroup, without: readonly number[] = []): Passage {
    const range = playhead.range();
    const isPlayed = (target: ServoTarget): boolean => isSent(target) && !without.includes(target.servo);
    const played = frames.map((frame): Frame => ({ ...frame, targets: frame.targets.filter(isPlayed) }));
    return passageOf(played, {
      fromMs: within() ?? range?.fromMs ?? 0,
      toMs: range?.toMs ?? null,
      seam: seamOf(source.family),
      longestMs: source.family.durationMs.max,
      speedPercent: chosen().speedPercent,
      unknownServos: source.robot.servos
        .map(({ servo }) => servo)
        .filter((servo) => !startsKnown(device.motion(servo))),
    });
  }

  function poseAt(atMs: number): FollowedPose {
    const pose = poseAtMs(motionTracks(document.store.getState().present), atMs);
    return new Map(
      [...pose].flatMap(([servo, position]) => (isSent({ servo }) ? [[servo, Math.round(position)]] : [])),
    );
  }

  return { within, part, passes, passage, poseAt };
}
