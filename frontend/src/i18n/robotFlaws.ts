// What is wrong with the description of a robot, in a sentence.

import {
  BATTERY_KINDS,
  BATTERY_MV,
  SUPPLY_MA,
  BATTERY_POLICIES,
  BODIES,
  NAME_LENGTH,
  type RobotFlaw,
  type ServoFlaw,
  type RobotField,
  type ServoInList,
} from '#shared/profile/robot.ts';
import type { RobotFileFlaw } from '#shared/profile/robotText.ts';
import { words } from './whole.ts';
import { say } from './sentences.ts';

export function robotFlawSentence(flaw: RobotFlaw): string {
  return words.robots.flaw({ flaw: robotFlawText(flaw) });
}

/** The flaw without the start of the sentence and its full stop. */
export function robotFlawText(flaw: RobotFileFlaw): string {
  const { field, strangeField, servoTwice, alarmNotBelow, servo, ...others } = words.robotFlaws;
  switch (flaw.code) {
    case 'field':
      return field({ place: placeText(flaw.of), field: flaw.field, wanted: wantedText(flaw.field) });
    case 'strangeField':
      return strangeField({ place: placeText(flaw.of), field: flaw.field });
    case 'servoTwice':
      return servoTwice(flaw);
    case 'alarmNotBelow':
      return alarmNotBelow(flaw);
    case 'servo':
      return servo({ ...flaw.servo, flaw: servoFlawText(flaw.flaw) });
    default:
      return others[flaw.code];
  }
}

function servoFlawText(flaw: ServoFlaw): string {
  const { range, ...flaws } = words.servoFlaws;
  switch (flaw.code) {
    case 'number':
      return flaws.number({ range: range(flaw.range) });
    case 'minNotBelowMax':
      return flaws.minNotBelowMax(flaw);
    case 'home':
    case 'trim':
      return flaws[flaw.code]({ value: flaw.value, range: range(flaw.range) });
    case 'beyondBoard':
      return flaws.beyondBoard({ range: range(flaw.range) });
    case 'noMirror':
      return flaws.noMirror(flaw);
  }
}

/** The servo in the file; empty for the robot itself. */
function placeText(servo: ServoInList | null): string {
  if (servo === null) return '';
  return servo.name.trim() === '' ? words.robotFlaws.place(servo) : words.robotFlaws.placeNamed(servo);
}

const CHOICES: Readonly<Partial<Record<RobotField, readonly string[]>>> = {
  body: BODIES,
  battery: BATTERY_KINDS,
  policy: BATTERY_POLICIES,
};

function wantedText(field: RobotField): string {
  const choices = (CHOICES[field] ?? []).join(words.comma);
  const range = field === 'supplyMa' ? SUPPLY_MA : BATTERY_MV;
  return say(words.robotFields[field], { most: NAME_LENGTH, ...range, choices });
}
