// Sentences about files of action groups: what is wrong with one, what does not fit, what a format cannot store.

import type { Misfit } from '#shared/files/fit.ts';
import type { Loss } from '#shared/files/writeGroupFile.ts';
import {
  type Place,
  type Problem,
  type Remark,
  type Unit,
  UNIT_RANGE,
  type Meaning,
} from '#shared/files/reading.ts';
import type { TextFlaw } from '#shared/document/schema.ts';
import type { Range } from '#shared/codec/families.ts';
import { flawSentence, say } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';

/** Up to this number frames are listed; more are counted. */
const NAMED_FRAMES = 5;

/** The label of the button that opens the dialog. */
export function filesText({
  opened,
  refused,
}: {
  readonly opened: number;
  readonly refused: number;
}): string {
  return [
    words.files.button,
    ...(opened === 0 ? [] : [words.files.opened({ count: opened })]),
    ...(refused === 0 ? [] : [words.files.notOpened({ count: refused })]),
  ].join(words.comma);
}

export function problemText({ code, place, found }: Problem): string {
  const { problems } = words.files;
  return code in problems
    ? placed(place, say(problems[code as keyof typeof problems], { found }))
    : placed(place, flawSentence({ code: code as TextFlaw['code'], at: found }));
}

export function remarkText({ code, place, found }: Remark): string {
  return placed(place, say(words.files.remarks[code], { found }));
}

function placed(place: Place | null, sentence: string): string {
  if (place === null) return sentence;
  return 'line' in place
    ? words.files.inLine({ ...place, sentence })
    : words.files.inFrame({ ...place, sentence });
}

export function misfitText({ code, frames, values, allowed, servo }: Misfit): string {
  const sentence = say(words.files.misfit[code], {
    ...{ values: spanText(values), allowed: spanText(allowed), most: allowed.max },
    ...{ count: values.max, slot: values.max, servo: servo ?? 0 },
  });
  return inFrames(sentence, frames);
}

export function lossText({ code, frames }: Loss): string {
  return inFrames(words.files.loss[code], frames);
}

function inFrames(sentence: string, frames: readonly number[]): string {
  const count = frames.length;
  if (count === 0 || frames[0] === 0) return sentence;
  const { formatList, formatWhole } = words.numbers;
  if (count <= NAMED_FRAMES) return words.files.inFrames({ sentence, count, frames: formatList(frames) });
  const named = frames.slice(0, NAMED_FRAMES).map(formatWhole).join(words.comma);
  return words.files.inManyFrames({ sentence, frames: named, more: count - NAMED_FRAMES });
}

/** The positions of a file in this unit, and whether they are possible. */
export function meaningText(unit: Unit, { positions, outside }: Meaning): string {
  const range = words.files.range({ span: spanText(UNIT_RANGE[unit]), unit: words.units[unit] });
  return positions === null ? range : words.files.meaning({ range, positions: spanText(positions), outside });
}

function spanText(range: Range): string {
  return range.min === range.max ? words.numbers.formatWhole(range.min) : words.files.span(range);
}
