// What a person is asked for in place, one field at a time: what stands in it at first, and what is done with the answer.

import { renameMarker, addMarker, setNote } from '#shared/group/frameEdits.ts';
import { GROUP_NAME_LENGTH, NOTE_LENGTH } from '#shared/group/group.ts';
import { scaleAmplitude, setPositions } from '#shared/group/keyEdits.ts';
import type { KeyStretch } from '#shared/group/keyRanges.ts';
import { insertTime } from '#shared/group/timeEdits.ts';
import { numberIn } from '../../../ui/NumberField.tsx';
import type { Ask } from './timeline.ts';
import type { Scale } from '../../drive/scale.ts';
import { servoName } from '../../profiles/servoName.ts';
import { words } from '../../../i18n/whole.ts';
import { apply, changeable, hasChangeable, rangeOf, selectedFrames, type Desk } from './desk.ts';
import { keyOf, selectedKeys, spanOf, timesOf } from './groupTimes.ts';
import { stretchingOf } from './moving.ts';
import { scaleAt } from './told.ts';

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
  const isMeant = written !== '' && Number.isFinite(by) && !(name === '/' && by === 0);
  return isMeant ? (BY[name]?.(by) ?? null) : null;
}

interface Range {
  readonly min: number;
  readonly max: number;
}

interface NumberAsk {
  readonly kind: 'number';
  unit(desk: Desk): string;
  range(desk: Desk): Range;
  /** As it stands in the field. */
  initial(desk: Desk): string;
  decimals?(desk: Desk): 0 | 1;
  take(desk: Desk, value: number): void;
}

interface TextAsk {
  readonly kind: 'text';
  readonly maxLength: number;
  initial(desk: Desk): string;
  take(desk: Desk, text: string): void;
}

export const ASKED: Readonly<Record<Ask, NumberAsk | TextAsk>> = {
  value: {
    kind: 'number',
    unit: (desk) => scaleAtCursor(desk).unit,
    range: commonRange,
    initial: (desk) => String(scaleAtCursor(desk).shown(changeableAtCursor(desk)?.position ?? 0)),
    decimals: (desk) => scaleAtCursor(desk).decimals,
    take: (desk, shown) => void setValues(desk, () => shown),
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
    take(desk, durationMs) {
      const next = insertTime(desk.group, desk.state.playheadMs, durationMs);
      if (next === desk.group) desk.stores.notices.tell('info', words.timeline.nothingBehind);
      else apply(desk, { label: () => words.timeline.steps.insertTime, edit: () => next });
    },
  },
  note: {
    kind: 'text',
    maxLength: NOTE_LENGTH,
    initial: (desk) => desk.times.frames.find(({ id }) => id === selectedFrames(desk)[0])?.note ?? '',
    take(desk, text) {
      const [frame] = selectedFrames(desk);
      if (frame !== undefined)
        apply(desk, { label: () => words.timeline.steps.note, edit: (group) => setNote(group, frame, text) });
    },
  },
  marker: {
    kind: 'text',
    maxLength: GROUP_NAME_LENGTH,
    initial: ({ group, state }) =>
      group.markers.find(({ id }) => id === state.marker)?.text ??
      words.timeline.newMarker({ number: group.markers.length + 1 }),
    take(desk, text) {
      const { marker, playheadMs } = desk.state;
      if (marker === null)
        apply(desk, {
          label: () => words.timeline.steps.addMarker,
          edit: (group) => addMarker(group, playheadMs, text),
        });
      else
        apply(desk, {
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
    take(desk, value) {
      const span = stretchedSpan(desk);
      if (span === null || !hasChangeable(desk)) return;
      apply(desk, {
        label: () => words.timeline.steps.scaleTime,
        ...stretchingOf(desk, span, { factor: value / 100, fixed }),
      });
    },
  };
}

/** The answer taken; what is wrong with it where it cannot be. */
export function answer(desk: Desk, ask: Ask, text: string): string | null {
  const asked = ASKED[ask];
  if (asked.kind === 'text') {
    asked.take(desk, text.trim());
    return null;
  }
  const decimals = asked.decimals?.(desk) ?? 0;
  const change = ask === 'value' ? changeIn(text, decimals) : null;
  if (change !== null) return setValues(desk, change);
  const value = numberIn(text, decimals);
  const { min, max } = asked.range(desk);
  if (Number.isNaN(value)) return null;
  if (value < min || value > max) return words.refused({ name: words.timeline.asks[ask], value, min, max });
  asked.take(desk, value);
  return null;
}

/** As they are shown. All of it or nothing: what is wrong where one of them cannot go there. */
function setValues(desk: Desk, change: (shown: number) => number): string | null {
  const keys = changeable(desk).map((ref) => {
    const scale = scaleAt(desk, ref.servo);
    return { ref, scale, shown: change(scale.shown(keyOf(desk.times, ref)?.position ?? 0)) };
  });
  const outside = keys.find(({ scale, shown }) => shown < scale.min || shown > scale.max);
  if (outside !== undefined) {
    const { shown, scale } = outside;
    return words.refused({ name: words.timeline.asks.value, value: shown, min: scale.min, max: scale.max });
  }
  const positions = keys.map(({ ref, scale, shown }) => ({ ...ref, position: scale.position(shown) }));
  apply(desk, { label: () => words.timeline.steps.value, edit: (group) => setPositions(group, positions) });
  return null;
}

/** All of it or nothing: none of the keys may go beyond what its servo can do. */
function swing(desk: Desk, percent: number): void {
  const refs = changeable(desk);
  const next = scaleAmplitude(desk.group, refs, percent / 100, 'mean');
  const times = timesOf(next);
  const outside = refs.find(({ servo, frameId }) => {
    const { min, max } = rangeOf(desk, servo);
    const position = keyOf(times, { servo, frameId })?.position ?? min;
    return position < min || position > max;
  });
  if (outside !== undefined)
    return desk.stores.notices.tell(
      'warning',
      words.timeline.swingsTooFar({ name: servoName(desk.robot, outside.servo) }),
    );
  apply(desk, { label: () => words.timeline.steps.scaleAmplitude, edit: () => next });
}

function changeableAtCursor(desk: Desk) {
  const refs = changeable(desk);
  const ref = refs.find(({ frameId }) => frameId === desk.state.cursor.frameId) ?? refs[0];
  return ref === undefined ? undefined : keyOf(desk.times, ref);
}

const scaleAtCursor = (desk: Desk): Scale => scaleAt(desk, changeableAtCursor(desk)?.servo ?? 0);

/** A number below zero is a position of all of the selected keys, as they are shown. */
export const mayBeNegative = (desk: Desk): boolean =>
  changeable(desk).length > 0 && commonRange(desk).min < 0;

/** What all of the selected servos can do, as it is shown. */
function commonRange(desk: Desk): Range {
  const scales = changeable(desk).map(({ servo }) => scaleAt(desk, servo));
  return {
    min: Math.max(...scales.map(({ min }) => min)),
    max: Math.min(...scales.map(({ max }) => max)),
  };
}

/** One frame is stretched from its beginning. */
function stretchedSpan(desk: Desk): { readonly fromMs: number; readonly toMs: number } | null {
  const span = spanOf(selectedKeys(desk.times, desk.state.selected));
  if (span === null || span.toMs > span.fromMs) return span;
  const index = desk.times.ends.findIndex((endMs) => endMs === span.toMs);
  return { fromMs: desk.times.ends[index - 1] ?? 0, toMs: span.toMs };
}
