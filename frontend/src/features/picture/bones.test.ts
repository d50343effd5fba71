import { describe, expect, test } from 'vitest';
import { exampleGroup, type ExampleId } from '#shared/group/examples/examples.ts';
import { poseAt } from '#shared/group/group.ts';
import { readyRobot, type ReadyRobotId } from '#shared/profile/readyRobots.ts';
import { robotNames } from '../../i18n/sentences.ts';
import { bonesOf, type Bone, type BonePicture } from './bones.ts';

const robot = (id: ReadyRobotId) => readyRobot(id, 'lsc-24', robotNames(id));
const posed = (positions: Record<number, number>) => (servo: number) => positions[servo] ?? 1500;
const bone = (id: ReadyRobotId, servo: number, pose: (servo: number) => number | null): Bone =>
  bonesOf(robot(id), pose)!.bones.find((one) => one.servo === servo)!;
const length = ({ from, to }: Bone): number => Math.hypot(to.x - from.x, to.y - from.y);

describe('a body by bones', () => {
  test('has a bone for each servo, and at home its joints are at their places', () => {
    for (const id of ['humanoid16', 'humanoid18', 'hexapod18'] as const) {
      const { bones } = bonesOf(robot(id), posed({}))!;
      expect(bones).toHaveLength(robot(id).servos.length);
      for (const { servo, place } of robot(id).servos) {
        const { from } = bones.find((one) => one.servo === servo)!;
        expect(from.x).toBeCloseTo(place.x);
        expect(from.y).toBeCloseTo(place.y);
      }
    }
  });

  test('a joint carries what is further out, and nothing else', () => {
    const [atHome, moved] = [posed({}), posed({ 3: 2000 })];
    const [knee, ankle, hip] = [3, 2, 5];
    expect(bone('humanoid16', knee, moved).to).not.toEqual(bone('humanoid16', knee, atHome).to);
    expect(bone('humanoid16', ankle, moved).from).toEqual(bone('humanoid16', knee, moved).to);
    expect(bone('humanoid16', hip, moved)).toEqual(bone('humanoid16', hip, atHome));
  });

  test('what an unknown joint carries is unknown too', () => {
    const unknownKnee = (servo: number) => (servo === 3 ? null : 1500);
    expect([5, 4, 3, 2, 1].map((servo) => bone('humanoid16', servo, unknownKnee).known)).toEqual([
      true,
      true,
      false,
      false,
      false,
    ]);
  });

  test('a leg seen from above swings at its first joint and gets shorter when lifted', () => {
    const [atHome, swung, lifted] = [posed({}), posed({ 1: 2000 }), posed({ 2: 2000 })];
    expect(length(bone('hexapod18', 2, swung))).toBeCloseTo(length(bone('hexapod18', 2, atHome)));
    expect(bone('hexapod18', 2, swung).to.y).not.toBeCloseTo(bone('hexapod18', 2, atHome).to.y);
    expect(length(bone('hexapod18', 2, lifted))).toBeLessThan(length(bone('hexapod18', 2, atHome)) * 0.8);
  });

  const examplePoses = (id: ReadyRobotId, example: ExampleId) => {
    const { frames } = exampleGroup(example, robot(id), example);
    const poses = frames.map((_, index) => poseAt(frames, index));
    return poses.map((pose) => bonesOf(robot(id), (servo) => pose.get(servo) ?? null)!);
  };
  const top = ({ trunk }: BonePicture): number => Math.min(...trunk.map(({ y }) => y));
  const feet = ({ bones }: BonePicture): number => Math.max(...bones.map(({ to }) => to.y));
  const offset = ({ trunk, shadow }: BonePicture): number => shadow[0]!.x - trunk[0]!.x;

  test('a humanoid that squats sinks onto its feet, and one that lifts a leg stands on the other', () => {
    const [stands, squats] = examplePoses('humanoid16', 'squat');
    expect(top(squats!) - top(stands!)).toBeGreaterThan(3);
    expect(feet(squats!)).toBeCloseTo(feet(stands!));
    const lifts = bonesOf(robot('humanoid16'), posed({ 4: 2200 }))!;
    expect(top(lifts)).toBeCloseTo(top(stands!));
  });

  test('a hexapod that rises has its shadow farther beside it, one that waves a leg has not', () => {
    const [sunk, risen] = examplePoses('hexapod18', 'rise');
    expect(offset(risen!)).toBeGreaterThan(offset(sunk!) + 4);
    const [lies, waves] = examplePoses('hexapod18', 'wave');
    expect(offset(waves!)).toBe(offset(lies!));
    expect(offset(bonesOf(robot('hexapod18'), posed({ 2: 1000 }))!)).toBe(offset(lies!));
  });

  test('a finger folds, and the base turns the whole hand', () => {
    expect(length(bone('hand', 2, posed({ 2: 2500 })))).toBeLessThan(
      length(bone('hand', 2, posed({ 2: 500 }))) / 2,
    );
    const [straight, turned] = [bone('hand', 3, posed({})), bone('hand', 3, posed({ 6: 2000 }))];
    expect(turned.to.x).not.toBeCloseTo(straight.to.x);
    expect(length(turned)).toBeCloseTo(length(straight));
  });

  test('an arm and a plain robot are drawn otherwise', () => {
    expect([robot('arm'), robot('plain16')].map((one) => bonesOf(one, posed({})))).toEqual([null, null]);
  });
});
