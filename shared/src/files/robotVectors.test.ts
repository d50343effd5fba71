// Robot documents as both languages read them: the facts, or what is wrong. Twin of backend/tests/test_robot_document.py.

import { expect, test } from 'vitest';
import vectors from '../../protocol/vectors/robots.json' with { type: 'json' };
import { EMPTY_BOOK, poseBookFromText } from '../profile/pose.ts';
import { kitFromText, robotFromText, type RobotFileFlaw } from '../profile/robotText.ts';
import { robotFactsOf, type RobotFacts } from './facts.ts';

interface Case {
  readonly what: string;
  readonly robot?: object;
  readonly poses?: object;
  readonly robotFile?: object;
  readonly robotText?: string;
  readonly posesFile?: object;
  readonly posesText?: string;
  readonly kitText?: string;
  readonly facts?: object;
  readonly flaw?: string;
}

function textOf({ robot, poses, robotFile, robotText, posesFile, posesText, kitText }: Case): string {
  const ofRobot = robotFile ?? {
    format: 'servodeck-robot',
    version: 1,
    robot: { ...vectors.robot, ...robot },
  };
  const ofPoses = posesFile ?? {
    format: 'servodeck-poses',
    version: 1,
    content: poses ?? vectors.posesBook,
  };
  const kit = {
    robot: robotText ?? JSON.stringify(ofRobot),
    poses: posesText ?? JSON.stringify(ofPoses),
    buttons: 'anything',
    pad: null,
  };
  return kitText ?? JSON.stringify({ format: 'servodeck-robot-kit', version: 1, kit });
}

function read(text: string): RobotFacts | string {
  const kit = kitFromText(text);
  if (kit === null) return 'kit';
  const robot = robotFromText(kit.robot);
  if ('problem' in robot) return codeOf(robot.problem);
  const poses = kit.poses === null ? { value: EMPTY_BOOK } : poseBookFromText(kit.poses);
  return 'problem' in poses ? `poses/${poses.problem.code}` : robotFactsOf(robot.robot, poses.value, 7);
}

function codeOf(flaw: RobotFileFlaw): string {
  if (flaw.code === 'servo') return `servo/${flaw.flaw.code}`;
  return flaw.code === 'field' ? `field ${flaw.field}` : flaw.code;
}

test.each(vectors.cases as readonly Case[])('$what', (each) => {
  expect(read(textOf(each))).toEqual(each.flaw ?? { ...vectors.facts, ...each.facts });
});
