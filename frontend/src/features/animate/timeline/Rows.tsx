// The rows for those who read or hear them: at the left each row's head, and over the tracks a cell for each key, in its place,
// which the eye sees painted. Only what is in sight is there, and a row is drawn again only where something of it changed.

import { memo } from 'react';
import { SharedSheet } from '../../picture/SharedSheet.tsx';
import { useDocument, useGroupBoard, useStores, useTimeline, useView } from '../../stores.ts';
import { keyName, type KeySet } from './timeline.ts';
import { cx } from '../../../ui/cx.ts';
import { useWords } from '../../../i18n/words.ts';
import { nameOfKey } from './valueText.ts';
import { keysOfFrame, timesOf, type GroupTimes } from '#shared/group/groupTimes.ts';
import { RowHead } from './RowHead.tsx';
import { type PlacedRow, keysInRow, keyY, type Row, type Sizes, within } from './rows.ts';
import { placedInSight } from './scene.ts';
import { seenSpan, xOf } from './timeScale.ts';
import styles from './Rows.module.css';

/** With more keys in sight only the cursor's row has cells, near the cursor. */
const MOST_CELLS = 150;
const BESIDE_CURSOR = 20;
const CELL_PX = 18;

export interface RowsProps {
  readonly rows: readonly Row[];
  readonly sizes: Sizes;
  readonly id: string;
  /** The same function each time. */
  openRowMenu(row: string, button: HTMLElement): void;
}

export const cellId = (grid: string, row: string, frameId: number | null): string =>
  `${grid} ${row} ${frameId ?? ''}`.replaceAll(' ', '-');

export function Rows({ rows, sizes, id, openRowMenu }: RowsProps) {
  const scrollTop = useTimeline((state) => state.scrollTop);
  const heightPx = useTimeline((state) => state.heightPx);
  const placed = placedInSight(rows, { scrollTop, heightPx }, sizes);
  const isDense = useIsDense(placed.map(({ row }) => row));
  return (
    <SharedSheet className={styles.rows}>
      {placed.map(({ row, ...place }) => (
        <RowParts key={row.id} {...{ row, ...place, id, isDense, openRowMenu }} index={rows.indexOf(row)} />
      ))}
    </SharedSheet>
  );
}

function useIsDense(rows: readonly Row[]): boolean {
  const time = useTimeline((state) => state.time);
  const widthPx = useTimeline((state) => state.widthPx);
  const span = seenSpan(time, widthPx);
  return useDocument(({ present }) => {
    const times = timesOf(present);
    const count = rows.reduce((sum, row) => {
      const [first, end] = within(keysInRow(row, times), span.fromMs, span.toMs);
      return sum + end - first;
    }, 0);
    return count > MOST_CELLS;
  });
}

const keysWithin = (row: Row, times: GroupTimes, { fromMs, toMs }: ReturnType<typeof seenSpan>) => {
  const keys = keysInRow(row, times);
  return keys.slice(...within(keys, fromMs, toMs)).filter(({ atMs }) => atMs >= fromMs && atMs <= toMs);
};

interface RowPartsProps extends PlacedRow {
  readonly index: number;
  readonly id: string;
  readonly isDense: boolean;
  openRowMenu(row: string, button: HTMLElement): void;
}

const RowParts = memo(function RowParts({ index, isDense, openRowMenu, ...placed }: RowPartsProps) {
  const { row, top, height, id } = placed;
  useWords();
  const isAtCursor = useTimeline(({ cursor }) => cursor.row === row.id);
  return (
    <div
      id={cellId(id, row.id, null)}
      role="row"
      aria-rowindex={index + 1}
      className={cx(styles.row, row.kind === 'all' && styles.all)}
      style={{ top, height }}
    >
      <RowHead row={row} isAtCursor={isAtCursor} openRowMenu={openRowMenu} />
      {(isAtCursor || !isDense) && <Cells {...placed} isDense={isDense} />}
    </div>
  );
});

type CellsProps = PlacedRow & Pick<RowPartsProps, 'id' | 'isDense'>;

function Cells({ row, top, height, range, id, isDense }: CellsProps) {
  const { document } = useStores();
  // What a cell says depends on these; each is the very same object as long as it is the same.
  useDocument(({ present }) => keysInRow(row, timesOf(present)));
  useDocument(({ present }) => timesOf(present).places);
  useDocument(({ present }) => present.unit);
  const time = useTimeline((state) => state.time);
  const widthPx = useTimeline((state) => state.widthPx);
  const selected = useTimeline((state) => state.selected);
  const cursor = useTimeline((state) => (isDense ? state.cursor.frameId : null));
  const { family, robot } = useGroupBoard();
  const positionsIn = useView((state) => state.positionsIn);
  const group = document.store.getState().present;
  const times = timesOf(group);
  const inSight = keysWithin(row, times, seenSpan(time, widthPx));
  const keys = isDense ? near(inSight, cursor) : inSight;
  return keys.map((key) => (
    <div
      key={key.frameId}
      id={cellId(id, row.id, key.frameId)}
      role="gridcell"
      aria-colindex={(times.places.get(key.frameId) ?? 0) + 1}
      aria-selected={isSelected(times, row, key.frameId, selected)}
      aria-label={nameOfKey({ robot, family, group, positionsIn, times }, row, key.frameId)}
      className={styles.cell}
      style={{
        insetInlineStart: `calc(var(--heads) + ${xOf(time, key.atMs) - CELL_PX / 2}px)`,
        top: keyY({ row, top, height, range }, key.position, family) - top - CELL_PX / 2,
      }}
    />
  ));
}

function near<Key extends { readonly frameId: number }>(
  keys: readonly Key[],
  cursor: number | null,
): readonly Key[] {
  const index = keys.findIndex(({ frameId }) => frameId === cursor);
  return keys.slice(Math.max(0, index - BESIDE_CURSOR), Math.max(0, index) + BESIDE_CURSOR);
}

function isSelected(times: GroupTimes, row: Row, frameId: number, selected: KeySet): boolean {
  if (selected.size === 0) return false;
  const keys = keysOfFrame(times, row.servos, frameId);
  return keys.length > 0 && keys.every((key) => selected.has(keyName(key)));
}
