// What a row and a cell of the grid are called, for ears.

import type { Cursor } from './timeline.ts';
import { instantText } from './instantText.ts';
import { words } from '../../../i18n/whole.ts';
import type { Desk } from './desk.ts';
import { keysOfFrame } from './groupTimes.ts';
import { scaleAt, type Reader } from './positions.ts';
import type { Row } from './rows.ts';

export function rowName({ kind, name, servos }: Row): string {
  if (kind === 'all') return words.timeline.rowAll;
  if (kind === 'limb') return name === '' ? words.servoPanel.noGroup : name;
  return name === '' ? words.servos.name({ servo: servos[0] ?? 0 }) : name;
}

export function cellName(desk: Reader & Pick<Desk, 'rows' | 'times'>, { row: id, frameId }: Cursor): string {
  const row = desk.rows.find((one) => one.id === id);
  return row === undefined ? '' : nameOfKey(desk, row, frameId);
}

export function nameOfKey(desk: Reader & Pick<Desk, 'times'>, row: Row, frameId: number | null): string {
  const { times } = desk;
  const name = rowName(row);
  const place = frameId === null ? undefined : times.places.get(frameId);
  if (frameId === null || place === undefined) return words.timeline.noKey({ row: name });
  const keys = keysOfFrame(times, row.servos, frameId);
  const [key] = keys;
  if (row.kind === 'servo' && key !== undefined)
    return words.timeline.key({
      ...{ row: name, at: instantText(key.atMs), position: scaleAt(desk, key.servo).text(key.position) },
      easing: words.timeline.easings[key.easing],
    });
  const at = instantText(times.ends[place] ?? 0);
  return words.timeline.summary({ row: name, frame: place + 1, at, count: keys.length });
}
