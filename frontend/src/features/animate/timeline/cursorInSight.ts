// Rows scroll so far that the cursor's is in sight, whoever moved it there; a row that is gone leaves the cursor to that of all
// servos, on the same frame, and keys on hidden rows are no longer selected. Knows elements and stores, no edit.

import { keySet } from './keySet.ts';
import { ALL_ROW } from './timeline.ts';
import { deskOf, rowOf, select, type DeskStores } from './desk.ts';
import { selectedKeys } from './groupTimes.ts';
import { placedRows, scrolledTo } from './rows.ts';
import { topOfRows, type Sizes } from './sizes.ts';

export function keepCursorInSight(
  scroller: Pick<HTMLElement, 'scrollTop' | 'clientHeight'>,
  stores: DeskStores,
  sizes: () => Sizes,
): () => void {
  function scroll(): void {
    const { rows, state } = deskOf(stores);
    const placed = placedRows(rows.slice(1), sizes()).find(({ row }) => row.id === state.cursor.row);
    if (placed === undefined) return;
    const { scrollTop, clientHeight } = scroller;
    const next = scrolledTo(placed, scrollTop, clientHeight - topOfRows(sizes()));
    if (next !== scrollTop) scroller.scrollTop = next;
  }

  function leaveGoneRow(): void {
    const desk = deskOf(stores);
    const { cursor, selected } = desk.state;
    const shown = new Set(rowOf(desk, ALL_ROW)?.servos);
    const left = selectedKeys(desk.times, selected).filter(({ servo }) => shown.has(servo));
    if (left.length < selected.size) select(stores, keySet(left));
    if (rowOf(desk, cursor.row) === undefined)
      stores.timeline.setState({ cursor: { ...cursor, row: ALL_ROW } });
  }

  const ends = [
    stores.timeline.subscribe(({ cursor }, before) => {
      if (cursor.row !== before.cursor.row) scroll();
    }),
    stores.view.subscribe(({ servos }, before) => {
      if (servos.hidden !== before.servos.hidden || servos.folded !== before.servos.folded) leaveGoneRow();
    }),
  ];
  return () => {
    for (const end of ends) end();
  };
}
