// The picture of a group: its robot in the pose of the middle frame, or bars where that robot is not known here.

import { useStore } from 'zustand';
import type { GroupFacts } from '#shared/files/factsShape.ts';
import { familyOfUnit } from '#shared/profile/counterpart.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { BarThumb, RobotThumb } from '../picture/PoseThumb.tsx';
import { useStores } from '../stores.ts';

export function DocumentThumb({ facts }: { readonly facts: GroupFacts }) {
  const { robots } = useStores();
  const robot = useStore(
    robots.store,
    ({ present }) => present.own.find((one) => one.robot.name === facts.robot)?.robot,
  );
  const pose = new Map(facts.pose.map(({ servo, position }) => [servo, position]));
  const isFitting = robot !== undefined && FAMILIES[robot.board].unit === facts.unit;
  const rest = { pose, changed: [...pose.keys()], family: familyOfUnit(facts.unit) };
  return isFitting ? (
    <RobotThumb {...rest} robot={robot} family={FAMILIES[robot.board]} />
  ) : (
    <BarThumb {...rest} />
  );
}
