// Servos by their numbers and names, as they stand in sentences.

import { words } from '../words.ts';

/** More are counted instead. */
const MOST_NAMED = 8;

/** Both knees of a body are called Knee, so the limb is added. */
export function servoLabel(servo: { readonly name: string; readonly group: string }): string {
  return servo.group === '' ? servo.name : words.robots.called(servo);
}

/** `Servo 3, Elbow`. */
export function numberAndName(servo: number, name: string): string {
  const number = words.servos.name({ servo });
  return name === number ? number : number + words.comma + name;
}

/** `Servos 1 and 2`: named while they fit into a line, else counted. */
export function servosText(servos: readonly number[]): string {
  const count = servos.length;
  return count > MOST_NAMED
    ? words.servoPanel.counted({ count })
    : words.servoPanel.named({ count, servos: words.numbers.formatList(servos) });
}

/** Of everything that is driven by hand from this screen. */
export function stayingSentence(names: readonly string[]): string {
  const count = names.length;
  const named = count > MOST_NAMED ? words.servoPanel.counted({ count }) : words.numbers.formatNames(names);
  return words.servoPanel.staying({ count, names: named });
}

export function waitingSentence(servos: readonly number[]): string {
  const count = servos.length;
  return count > MOST_NAMED
    ? words.firstMoves.waitingMany({ count })
    : words.firstMoves.waiting({ count, servos: words.numbers.formatList(servos) });
}
