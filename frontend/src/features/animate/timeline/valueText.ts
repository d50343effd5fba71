// Times and values on the timeline as text, also those of what is dragged. Changes nothing.

import { beatNear } from '#shared/group/beats.ts';
import { EASINGS, handlesOf, sameEasing, type Bezier, type Easing } from '#shared/group/curves.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { words, type Words } from '../../../i18n/whole.ts';
import { inUnits, scaleOf, type Scale } from '../../drive/scale.ts';
import { rangeOf, type TimelineContext, contextOf, type TimelineStores } from './context.ts';
import type { Cursor } from './timeline.ts';
import { keysOfFrame, endOfFrame } from '#shared/group/groupTimes.ts';
import type { Row } from './rows.ts';

/** Curves that have a name. */
export const EASING_CHOICES: readonly { readonly name: EasingName; readonly easing: Easing }[] = [
  ...EASINGS.map((name) => ({ name, easing: name })),
  { name: 'overshoot', easing: [0.34, 1.56, 0.64, 1] },
  { name: 'windUp', easing: [0.36, 0, 0.66, -0.56] },
];
export type EasingName = keyof Words['timeline']['easings'];

const formats = [0, 1, 2, 3].map(
  (decimals) =>
    new Intl.NumberFormat('en', {
      useGrouping: false,
      minimumFractionDigits: decimals,
      maximumFractionDigits: decimals,
    }),
);

const fixed = (value: number, decimals: number): string => formats[decimals]?.format(value) ?? '';

/** `1.50`, or with three decimals where hundredths would hide something. */
export const secondsText = (atMs: number): string => fixed(atMs / 1000, atMs % 10 === 0 ? 2 : 3);

/** With as many decimals as the ruler's step has; from a minute on as `1:05`. */
export function markText(atMs: number, stepMs: number): string {
  const decimals = [1000, 100, 10, 1].findIndex((part) => stepMs % part === 0);
  if (atMs < 60_000) return fixed(atMs / 1000, decimals);
  const seconds = fixed((atMs % 60_000) / 1000, decimals);
  return `${Math.floor(atMs / 60_000)}:${atMs % 60_000 < 10_000 ? '0' : ''}${seconds}`;
}

// An instant of a group with its unit, as it stands in sentences.

export const instantText = (atMs: number): string => words.timeline.instant({ seconds: secondsText(atMs) });

// Positions as the person reads them: in the units of the group, or in degrees where the current robot counts in the
// same.

type Reader = Pick<TimelineContext, 'robot' | 'family' | 'positionsIn'> & {
  readonly group: Pick<TimelineContext['group'], 'unit'>;
};

export function scaleAt({ robot, family, group, positionsIn }: Reader, servo: number): Scale {
  const own = servoOf(robot, servo);
  return own !== undefined && group.unit === family.unit
    ? scaleOf(own, family, positionsIn)
    : inUnits(rangeOf({ robot, family }, servo), group.unit);
}

/** How far an arrow key turns the servo, in the group's units: by one of what is shown, as near as can be. */
export function nudgeUnits(reader: Reader, servo: number): number {
  return Math.max(1, Math.round(1 / unitsShown(reader, servo)));
}

export function turnText(reader: Reader, servo: number): string {
  const scale = scaleAt(reader, servo);
  const shown = nudgeUnits(reader, servo) * unitsShown(reader, servo);
  return scale.isDegrees
    ? words.numbers.formatDegrees(shown, scale.decimals)
    : words.position[reader.group.unit]({ position: shown });
}

/** What one unit of the group comes to where it is shown. */
function unitsShown(reader: Reader, servo: number): number {
  return scaleAt(reader, servo).isDegrees ? (servoOf(reader.robot, servo)?.degreesPerUnit ?? 1) : 1;
}

// What a row and a cell of the grid are called, for ears.

export function rowName({ kind, name, servos }: Row): string {
  if (kind === 'all') return words.timeline.rowAll;
  if (kind === 'limb') return name === '' ? words.servoPanel.noGroup : name;
  return name === '' ? words.servos.name({ servo: servos[0] ?? 0 }) : name;
}

export function cellName(
  context: Reader & Pick<TimelineContext, 'rows' | 'times'>,
  { row: id, frameId }: Cursor,
): string {
  const row = context.rows.find((one) => one.id === id);
  return row === undefined ? '' : nameOfKey(context, row, frameId);
}

export function nameOfKey(
  context: Reader & Pick<TimelineContext, 'times'>,
  row: Row,
  frameId: number | null,
): string {
  const { times } = context;
  const name = rowName(row);
  const place = frameId === null ? undefined : times.places.get(frameId);
  if (frameId === null || place === undefined) return words.timeline.noKey({ row: name });
  const keys = keysOfFrame(times, row.servos, frameId);
  const [key] = keys;
  if (row.kind === 'servo' && key !== undefined)
    return words.timeline.key({
      ...{ row: name, at: instantText(key.atMs), position: scaleAt(context, key.servo).text(key.position) },
      easing: easingText(key.easing),
    });
  const at = instantText(times.ends[place] ?? 0);
  return words.timeline.summary({ row: name, frame: place + 1, at, count: keys.length });
}

/** By its name where it has one, else by its numbers. */
export function easingText(easing: Easing): string {
  const name = EASING_CHOICES.find((one) => sameEasing(one.easing, easing))?.name;
  if (name !== undefined) return words.timeline.easings[name];
  const [x1 = 0, y1 = 0, x2 = 0, y2 = 0] = handlesOf(easing) ?? [];
  return words.timeline.curve({ handles: handlesText([x1, y1, x2, y2]) });
}

export const handlesText = (handles: Bezier): string =>
  handles.map((share) => String(Math.round(share * 1000) / 1000)).join(' ');

/** The key under the hand, how far it has come in time, and how many come along. */
export function keyText(stores: TimelineStores, cursor: Cursor, fromMs: number): string {
  const context = contextOf(stores);
  const atMs = endOfFrame(context.times, cursor.frameId) ?? fromMs;
  const count = context.state.selected.size;
  return draggedKey(cellName(context, cursor), atMs - fromMs, count, beatAt(context.group, atMs));
}

export function frameText(stores: TimelineStores, frameId: number): string {
  const { times, group } = contextOf(stores);
  const place = times.places.get(frameId) ?? -1;
  const durationMs = times.frames[place]?.durationMs ?? 0;
  const endMs = times.ends[place] ?? 0;
  const text = words.timeline.draggedEnd({ frame: place + 1, durationMs, at: instantText(endMs) });
  return parts([text, ...beatAt(group, endMs)]);
}

export function markerText({ document }: TimelineStores, id: number): string {
  const group = document.store.getState().present;
  const marker = group.markers.find((one) => one.id === id);
  if (marker === undefined) return '';
  const text = words.timeline.draggedMarker({ text: marker.text, at: instantText(marker.atMs) });
  return parts([text, ...beatAt(group, marker.atMs)]);
}

/** Where the playhead is, while it is dragged; empty where that says no more than the time above the names. */
export function playheadText({ document, timeline }: TimelineStores): string {
  return parts(beatAt(document.store.getState().present, timeline.getState().playheadMs));
}

/** `beat 12`, on that beat of the group's sound and nowhere else. */
function beatAt({ sound }: Pick<ActionGroup, 'sound'>, atMs: number): readonly string[] {
  const beat = beatNear(sound, atMs);
  return beat?.atMs === atMs ? [words.sound.beat({ number: beat.number + 1 })] : [];
}

const parts = (facts: readonly string[]): string =>
  facts.length === 0 ? '' : facts.reduce((one, other) => words.timeline.draggedParts({ one, other }));

export function rangeText({ timeline }: TimelineStores): string {
  const { range } = timeline.getState();
  if (range === null) return '';
  const { fromMs, toMs } = range;
  return words.timeline.draggedRange({
    ...{ from: instantText(fromMs), to: instantText(toMs), length: instantText(toMs - fromMs) },
  });
}

export const boxText = ({ timeline }: TimelineStores): string =>
  words.timeline.keys({ count: timeline.getState().selected.size });

/** `count`: with those that come along. */
function draggedKey(key: string, byMs: number, count: number, beat: readonly string[]): string {
  return parts([
    key,
    ...(byMs === 0 ? [] : [`${byMs < 0 ? '−' : '+'}${instantText(Math.abs(byMs))}`]),
    ...beat,
    ...(count < 2 ? [] : [words.timeline.keys({ count })]),
  ]);
}
