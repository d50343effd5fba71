// The values that a person enters in place, one field at a time: what stands in it at first, and what is done with the answer.

import { renameMarker, addMarker, setNote } from '#shared/group/frameEdits.ts';
import { GROUP_NAME_LENGTH, NOTE_LENGTH } from '#shared/group/group.ts';
import { handlesOf, HIGHEST_HANDLE, LOWEST_HANDLE, type Bezier } from '#shared/group/curves.ts';
import { scaleAmplitude, setEasing, setPositions } from '#shared/group/keyEdits.ts';
import type { KeyStretch } from '#shared/group/keyRanges.ts';
import { insertTime } from '#shared/group/timeEdits.ts';
import { numberIn } from '../../../ui/NumberField.tsx';
import { type Ask, selectedKeys } from './timeline.ts';
import type { Scale } from '../../drive/scale.ts';
import { servoName } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import {
  apply,
  changeable,
  hasChangeable,
  rangeOf,
  selectedFrames,
  type TimelineContext,
} from './context.ts';
import { keyOf, spanOf, timesOf } from '#shared/group/groupTimes.ts';
import { stretchingOf } from './moving.ts';
import { handlesText, scaleAt } from './valueText.ts';

// A number that is typed with a sign before it: not a new one, but what becomes of the one that is there. A minus
// alone begins a number below zero.

const CHANGE = /^(\+=?|[-−]=|[*×/÷])(.+)$/u;
/** Of a factor. */
const EXACT = 3;

const BY: Readonly<Record<string, (by: number) => (value: number) => number>> = {
  '+': (by) => (value) => value + by,
  '-': (by) => (value) => value - by,
  '*': (by) => (value) => value * by,
  '/': (by) => (value) => value / by,
};
const SIGNS: Readonly<Record<string, string>> = { '−': '-', '×': '*', '÷': '/' };

/** `+10`, `-=10`, `*1.2`, `/2`; null where it is no change. */
function changeIn(text: string, decimals: 0 | 1): ((value: number) => number) | null {
  const [, sign = '', written = ''] = CHANGE.exec(text.replaceAll(/\s/gu, '')) ?? [];
  const name = SIGNS[sign.charAt(0)] ?? sign.charAt(0);
  const isFactor = name === '*' || name === '/';
  const by = isFactor
    ? Number(Number(written.replace(',', '.')).toFixed(EXACT))
    : numberIn(written, decimals);
  const isWanted = written !== '' && Number.isFinite(by) && !(name === '/' && by === 0);
  return isWanted ? (BY[name]?.(by) ?? null) : null;
}

/** Two handles, as `cubic-bezier()` in CSS has them, with or without commas; null where it is none. */
function curveIn(text: string): Bezier | null {
  const [x1, y1, x2, y2, ...more] = text
    .replaceAll(/cubic-bezier|[(),;]/gu, ' ')
    .trim()
    .split(/\s+/u)
    .map((one) => Number(one.replace('−', '-')));
  if (x1 === undefined || y1 === undefined || x2 === undefined || y2 === undefined) return null;
  const isCurve =
    more.length === 0 &&
    [x1, x2].every((share) => share >= 0 && share <= 1) &&
    [y1, y2].every((share) => share >= LOWEST_HANDLE && share <= HIGHEST_HANDLE);
  return isCurve ? [x1, y1, x2, y2] : null;
}

const STRAIGHT: Bezier = [0, 0, 1, 1];

interface Range {
  readonly min: number;
  readonly max: number;
}

interface NumberAsk {
  readonly kind: 'number';
  unit(context: TimelineContext): string;
  range(context: TimelineContext): Range;
  /** As it stands in the field. */
  initial(context: TimelineContext): string;
  decimals?(context: TimelineContext): 0 | 1;
  take(context: TimelineContext, value: number): void;
}

interface TextAsk {
  readonly kind: 'text';
  readonly maxLength: number;
  initial(context: TimelineContext): string;
  take(context: TimelineContext, text: string): void;
}

export const QUESTIONS: Readonly<Record<Ask, NumberAsk | TextAsk>> = {
  value: {
    kind: 'number',
    unit: (context) => scaleAtCursor(context).unit,
    range: commonRange,
    initial: (context) => String(scaleAtCursor(context).shown(changeableAtCursor(context)?.position ?? 0)),
    decimals: (context) => scaleAtCursor(context).decimals,
    take: (context, shown) => void setValues(context, () => shown),
  },
  scaleTime: scalingTime('first'),
  scaleTimeBack: scalingTime('last'),
  scaleAmplitude: {
    kind: 'number',
    unit: () => words.timeline.percent,
    range: () => ({ min: -1000, max: 1000 }),
    initial: () => '100',
    take: swing,
  },
  insertTime: {
    kind: 'number',
    unit: () => words.servos.ms,
    range: ({ family }) => ({ min: 1, max: family.durationMs.max }),
    initial: () => '500',
    take(context, durationMs) {
      const next = insertTime(context.group, context.state.playheadMs, durationMs);
      if (next === context.group) context.stores.notices.show('info', words.timeline.nothingBehind);
      else apply(context, { label: () => words.timeline.steps.insertTime, edit: () => next });
    },
  },
  curve: {
    kind: 'text',
    maxLength: 40,
    initial: (context) => handlesText(handlesOf(changeableAtCursor(context)?.easing ?? 'linear') ?? STRAIGHT),
    take(context, text) {
      if (!hasChangeable(context)) return;
      const curve = curveIn(text);
      const refs = changeable(context);
      if (curve !== null)
        apply(context, {
          label: () => words.timeline.steps.curve,
          edit: (group) => setEasing(group, refs, curve),
        });
      else
        context.stores.notices.show(
          'warning',
          words.timeline.notACurve({ min: LOWEST_HANDLE, max: HIGHEST_HANDLE }),
        );
    },
  },
  note: {
    kind: 'text',
    maxLength: NOTE_LENGTH,
    initial: (context) =>
      context.times.frames.find(({ id }) => id === selectedFrames(context)[0])?.note ?? '',
    take(context, text) {
      const [frame] = selectedFrames(context);
      if (frame !== undefined)
        apply(context, {
          label: () => words.timeline.steps.note,
          edit: (group) => setNote(group, frame, text),
        });
    },
  },
  marker: {
    kind: 'text',
    maxLength: GROUP_NAME_LENGTH,
    initial: ({ group, state }) =>
      group.markers.find(({ id }) => id === state.marker)?.text ??
      words.timeline.newMarker({ number: group.markers.length + 1 }),
    take(context, text) {
      const { marker, playheadMs } = context.state;
      if (marker === null)
        apply(context, {
          label: () => words.timeline.steps.addMarker,
          edit: (group) => addMarker(group, playheadMs, text),
        });
      else
        apply(context, {
          label: () => words.timeline.steps.renameMarker,
          edit: (group) => renameMarker(group, marker, text),
        });
    },
  },
};

function scalingTime(fixed: KeyStretch['fixed']): NumberAsk {
  return {
    kind: 'number',
    unit: () => words.timeline.percent,
    range: () => ({ min: 1, max: 10_000 }),
    initial: () => '100',
    take(context, value) {
      const span = stretchedSpan(context);
      if (span === null || !hasChangeable(context)) return;
      apply(context, {
        label: () => words.timeline.steps.scaleTime,
        ...stretchingOf(context, span, { factor: value / 100, fixed }),
      });
    },
  };
}

/** The answer taken; what is wrong with it where it cannot be. */
export function answer(context: TimelineContext, ask: Ask, text: string): string | null {
  const question = QUESTIONS[ask];
  if (question.kind === 'text') {
    question.take(context, text.trim());
    return null;
  }
  const decimals = question.decimals?.(context) ?? 0;
  const change = ask === 'value' ? changeIn(text, decimals) : null;
  if (change !== null) return setValues(context, change);
  const value = numberIn(text, decimals);
  const { min, max } = question.range(context);
  if (Number.isNaN(value)) return null;
  if (value < min || value > max)
    return words.refused({ name: words.timeline.questions[ask], value, min, max });
  question.take(context, value);
  return null;
}

/** As they are shown. All of it or nothing: what is wrong where one of them cannot go there. */
function setValues(context: TimelineContext, change: (shown: number) => number): string | null {
  const keys = changeable(context).map((ref) => {
    const scale = scaleAt(context, ref.servo);
    return { ref, scale, shown: change(scale.shown(keyOf(context.times, ref)?.position ?? 0)) };
  });
  const beyond = keys.find(({ scale, shown }) => shown < scale.min || shown > scale.max);
  if (beyond !== undefined) {
    const { shown, scale } = beyond;
    return words.refused({
      name: words.timeline.questions.value,
      value: shown,
      min: scale.min,
      max: scale.max,
    });
  }
  const positions = keys.map(({ ref, scale, shown }) => ({ ...ref, position: scale.position(shown) }));
  apply(context, {
    label: () => words.timeline.steps.value,
    edit: (group) => setPositions(group, positions),
  });
  return null;
}

/** All of it or nothing: none of the keys may go beyond what its servo can do. */
function swing(context: TimelineContext, percent: number): void {
  const refs = changeable(context);
  const next = scaleAmplitude(context.group, refs, percent / 100, 'mean');
  const times = timesOf(next);
  const beyond = refs.find(({ servo, frameId }) => {
    const { min, max } = rangeOf(context, servo);
    const position = keyOf(times, { servo, frameId })?.position ?? min;
    return position < min || position > max;
  });
  if (beyond !== undefined)
    return context.stores.notices.show(
      'warning',
      words.timeline.swingsTooFar({ name: servoName(context.robot, beyond.servo) }),
    );
  apply(context, { label: () => words.timeline.steps.scaleAmplitude, edit: () => next });
}

function changeableAtCursor(context: TimelineContext) {
  const refs = changeable(context);
  const ref = refs.find(({ frameId }) => frameId === context.state.cursor.frameId) ?? refs[0];
  return ref === undefined ? undefined : keyOf(context.times, ref);
}

const scaleAtCursor = (context: TimelineContext): Scale =>
  scaleAt(context, changeableAtCursor(context)?.servo ?? 0);

/** A number below zero is a position of all of the selected keys, as they are shown. */
export const mayBeNegative = (context: TimelineContext): boolean =>
  changeable(context).length > 0 && commonRange(context).min < 0;

/** What all of the selected servos can do, as it is shown. */
function commonRange(context: TimelineContext): Range {
  const scales = changeable(context).map(({ servo }) => scaleAt(context, servo));
  return {
    min: Math.max(...scales.map(({ min }) => min)),
    max: Math.min(...scales.map(({ max }) => max)),
  };
}

/** One frame is stretched from its beginning. */
function stretchedSpan(context: TimelineContext): { readonly fromMs: number; readonly toMs: number } | null {
  const span = spanOf(selectedKeys(context.times, context.state.selected));
  if (span === null || span.toMs > span.fromMs) return span;
  const index = context.times.ends.findIndex((endMs) => endMs === span.toMs);
  return { fromMs: context.times.ends[index - 1] ?? 0, toMs: span.toMs };
}
