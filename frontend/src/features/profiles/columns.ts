// The columns of the table of servos: how each value is displayed, and the robot that results from a typed text. Pure; `flawOf` checks
// the whole robot.

import type { Robot, RobotServo } from '#shared/profile/robot.ts';
import { changeServo, renumber } from '#shared/profile/robotEdits.ts';
import { words } from '../../i18n/whole.ts';

export type ColumnId = 'servo' | 'name' | 'group' | 'min' | 'home' | 'max' | 'trim' | 'degreesPerUnit';

export type Edited = { readonly robot: Robot } | { readonly problem: string };

export interface Column {
  readonly id: ColumnId;
  readonly isNumber: boolean;
  show(servo: RobotServo): string;
  edit(robot: Robot, servo: RobotServo, text: string): Edited;
}

const whole =
  (take: (robot: Robot, servo: number, value: number) => Robot): Column['edit'] =>
  (robot, { servo }, text) => {
    const value = Number(text);
    if (text.trim() === '' || !Number.isInteger(value))
      return { problem: words.robotEditor.notWhole({ text }) };
    return { robot: take(robot, servo, value) };
  };

const figure = (id: 'min' | 'home' | 'max' | 'trim'): Column => ({
  id,
  isNumber: true,
  show: (servo) => String(servo[id]),
  edit: whole((robot, servo, value) => changeServo(robot, servo, { [id]: value })),
});

export const COLUMNS: readonly Column[] = [
  { id: 'servo', isNumber: true, show: ({ servo }) => String(servo), edit: whole(renumber) },
  {
    id: 'name',
    isNumber: false,
    show: ({ name }) => name,
    edit: (robot, { servo }, text) =>
      text.trim() === ''
        ? { problem: words.robotEditor.noName }
        : { robot: changeServo(robot, servo, { name: text.trim() }) },
  },
  {
    id: 'group',
    isNumber: false,
    show: ({ group }) => group,
    edit: (robot, { servo }, text) => ({ robot: changeServo(robot, servo, { group: text.trim() }) }),
  },
  figure('min'),
  figure('home'),
  figure('max'),
  figure('trim'),
  {
    id: 'degreesPerUnit',
    isNumber: true,
    show: ({ degreesPerUnit }) => String(degreesPerUnit),
    edit(robot, { servo }, text) {
      const degreesPerUnit = Number(text.replace(',', '.'));
      if (text.trim() === '' || Number.isNaN(degreesPerUnit))
        return { problem: words.robotEditor.notNumber({ text }) };
      return { robot: changeServo(robot, servo, { degreesPerUnit }) };
    },
  },
];
