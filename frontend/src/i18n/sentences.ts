// Sentences that several features use: about failures, boards, robots, servos, slots and people. Knows values, no state.

import type { Family, SlotTrigger } from '#shared/codec/families.ts';
import type { ReadyRobotId, RobotNames } from '#shared/profile/readyRobots.ts';
import type { SlotContent } from '#shared/group/slotBook.ts';
import type { LibraryErrorCode } from '#shared/files/documentStore.ts';
import type { TextFlaw } from '#shared/document/schema.ts';
import type { RangeRefusal } from '#shared/codec/encode.ts';
import type { LinkError, LinkErrorCode } from '#shared/robot/linkError.ts';
import { words } from './words.ts';
import { NAME_LENGTH, servoOf, type Robot } from '#shared/profile/robot.ts';

/** Formats one of several messages, of which some take values and some are plain text. */
export function say<Values>(message: string | ((values: Values) => string), values: Values): string {
  return typeof message === 'string' ? message : message(values);
}

/** The maker's name of a board, or the one in the language in use. */
export function boardName({ id, name }: Pick<Family, 'id' | 'name'>): string {
  const names: Readonly<Partial<Record<Family['id'], string>>> = words.boards;
  return names[id] ?? name;
}

/** The names of a template robot and of its parts when it is added. */
export function robotNames(id: ReadyRobotId): RobotNames {
  return {
    robot: words.robots.readyNames[id],
    role: (role, servo) => (role === 'servo' ? words.servos.name({ servo }) : words.robots.roles[role]),
    limb: (limb) => words.robots.limbs[limb],
  };
}

/** Up to this number servos are named; more are counted. */
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

/** `Servos 1 and 2`: listed while they fit into a line, else counted. */
export function servosText(servos: readonly number[]): string {
  const count = servos.length;
  return count > MOST_NAMED
    ? words.servoPanel.counted({ count })
    : words.servoPanel.named({ count, servos: words.numbers.formatList(servos) });
}

/** For moves from this screen that leave locked servos in place. */
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

export function downloadedSentence(slots: readonly number[]): string {
  return words.board.downloaded({ count: slots.length, slot: slots[0] ?? 0 });
}

/** `broken` is null if it was cancelled between two groups. */
export function downloadCancelled(broken: number | null): string {
  return broken === null ? words.board.downloadCancelled : words.board.downloadBroke({ slot: broken });
}

/** A slot's content in a few words; `name` is the name of its group, if known. */
export function heldText(content: SlotContent, name: string): string {
  return content === 'other' && name !== '' ? words.slots.inBarNamed({ name }) : words.slots.inBar[content];
}

/** As a sentence. */
export function triggerText(trigger: SlotTrigger): string {
  const { pad, chain, ...others } = words.slots.triggers;
  if (trigger.kind === 'pad') return pad({ button: words.slots.padButtons[trigger.button] });
  return trigger.kind === 'chain' ? chain({ slot: trigger.after }) : others[trigger.kind];
}

/** In a few words. */
export function triggerInBar(trigger: SlotTrigger): string {
  const { pad, chain, ...others } = words.slots.triggersInBar;
  if (trigger.kind === 'pad') return pad({ button: words.slots.padSigns[trigger.button] });
  return trigger.kind === 'chain' ? chain({ slot: trigger.after }) : others[trigger.kind];
}

/** The gateway's names for clients without pairing. */
const SCRIPT = 'A script on this computer';
const COMPUTER = 'This computer';

/** At the start of a sentence. A person with the name `you` is another window of the same browser or computer. */
export function personName(name: string, you: string): string {
  return named(name, you, words.lease.names);
}

/** Within a sentence. */
export function personWithin(name: string, you: string): string {
  return named(name, you, words.lease.namesWithin);
}

function named(
  name: string,
  you: string,
  ours: { readonly window: string; readonly script: string },
): string {
  if (name === you) return ours.window;
  return name === SCRIPT ? ours.script : name;
}

/** `by` is null if unknown. */
export function stoppedBy(by: string | null): string {
  if (by === null) return words.stop.elsewhere;
  if (by === COMPUTER) return words.stop.atComputer;
  return by === SCRIPT ? words.stop.byScript : words.stop.stoppedBy({ name: by });
}

export function mayResumeText({
  driver,
  you,
}: {
  readonly driver: string | null;
  readonly you: string;
}): string {
  return driver === null ? words.stop.onlyDriver : words.stop.mayResume({ name: personName(driver, you) });
}

/** Omits `detail` if the sentence is complete without it. */
export function errorSentence(code: LinkErrorCode, detail = ''): string {
  const detailed = words.errorsWithDetail;
  return code in detailed && isForReader(code, detail)
    ? detailed[code as keyof typeof detailed]({ detail: detail.replace(/[.。]$/u, '') })
    : words.errors[code];
}

/** Of an error of a link, with the programs that have its port. */
export function linkSentence({
  code,
  message,
  heldBy,
}: Pick<LinkError, 'code' | 'message' | 'heldBy'>): string {
  return heldBy.length > 0
    ? words.link.heldBy({ programs: heldBy.join(words.comma) })
    : errorSentence(code, message);
}

/** Details of programs are in English: other languages show them only for internal errors, or if they are not plain ASCII. */
function isForReader(code: LinkErrorCode, detail: string): boolean {
  if (detail === '') return false;
  return words.locale === 'en' || code === 'internal' || /\P{ASCII}/u.test(detail);
}

/** The value that a board refuses and the allowed range; not a complete sentence. */
export function rangeText({ field, value, min, max, allowed = '', servo }: RangeRefusal): string {
  const { fields, ofServo, servoTwice, range, notTaken } = words.refusals;
  const name = servo === undefined ? fields[field] : ofServo({ field: fields[field], servo });
  if (min !== undefined && max !== undefined) return range({ field: name, value: String(value), min, max });
  if (field === 'servo') return servoTwice({ value: String(value) });
  return notTaken({ field: name, value: String(value), allowed });
}

/** What is wrong with a stored document or a file. */
export function flawSentence({ code, at }: TextFlaw): string {
  if (code === 'sameNumber' && at === '') return words.flaws.sameNumberInFile;
  return say(words.flaws[code], { found: at });
}

export function libraryProblem(code: LibraryErrorCode, detail: string): string {
  return say(words.library.problems[code], { detail });
}

/** A name with an addition, such as “Wave, other version”. Cuts the name, not the addition, to the longest name allowed. */
export function longerName(name: string, added: (values: { readonly name: string }) => string): string {
  return added({ name: name.slice(0, NAME_LENGTH - added({ name: '' }).length).trim() });
}

/** For sentences about several of them. */
export const namesIn =
  (robot: Robot) =>
  (servo: number): string =>
    servoName(robot, servo);

/** By its number where the robot has no such servo. */
export function servoName(robot: Robot, servo: number): string {
  const own = servoOf(robot, servo);
  return own === undefined ? words.servos.name({ servo }) : servoLabel(own);
}
