// What a row and a cell of the grid are called, for ears.

import type { Cursor } from '../stores/timeline/timeline.ts';
import { words } from '../words/whole.ts';
import type { Desk } from './desk.ts';
import { keysOfFrame } from './groupTimes.ts';
import { scaleAt, type Reader } from './positions.ts';
import type { Row } from './rows.ts';

export function rowName({ kind, name, servos }: Row): string {
  if (kind === 'all') return words.timeline.rowAll;
  if (kind === 'limb') return name === '' ? words.servoPanel.noGroup : name;
  return name === '' ? words.timeline.noName(servos[0] ?? 0) : name;
}

export function cellName(desk: Reader & Pick<Desk, 'rows' | 'times'>, { row: id, frameId }: Cursor): string {
  const row = desk.rows.find((one) => one.id === id);
  return row === undefined ? '' : nameOfKey(desk, row, frameId);
}

export function nameOfKey(desk: Reader & Pick<Desk, 'times'>, row: Row, frameId: number | null): string {
  const { times } = desk;
  const name = rowName(row);
  const place = frameId === null ? undefined : times.places.get(frameId);
  if (frameId === null || place === undefined) return words.timeline.noKey(name);
  const keys = keysOfFrame(times, row.servos, frameId);
  const [key] = keys;
  if (row.kind === 'servo' && key !== undefined)
    return words.timeline.key(name, key.atMs, scaleAt(desk, key.servo).text(key.position), key.easing);
  return words.timeline.summary(name, place + 1, times.ends[place] ?? 0, keys.length);
}
