// What a servo turns, as far as the picture of its robot tells, and from where one sees it turn. Pure.

import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import { JOINT } from '../../picture/pose.ts';

/** Where one looks from, as the picture of the arm does; other bodies have no picture of a turn. */
export type Sight = 'gripper' | 'side' | 'above' | 'front' | 'horn';

const ARM_SIGHTS: Readonly<Record<number, Sight>> = {
  [JOINT.gripper]: 'gripper',
  [JOINT.roll]: 'front',
  [JOINT.wrist]: 'side',
  [JOINT.elbow]: 'side',
  [JOINT.shoulder]: 'side',
  [JOINT.base]: 'above',
};

export const sightOf = ({ body }: Robot, { servo }: RobotServo): Sight =>
  (body === 'arm' ? ARM_SIGHTS[servo] : undefined) ?? 'horn';
