// The rows for those who read or hear them: at the left each row's name, its position at the playhead and what is done to it, and
// over the lanes a cell for each key, in its place, which the eye sees painted. Only what is in sight is there.

import { memo } from 'react';
import { isHeld, isSilent, toggled } from '../stores/servoView.ts';
import { editServoView, useStores } from '../stores/stores.ts';
import { keyName } from '../stores/keySet.ts';
import { Icon } from '../ui/Icon.tsx';
import { cx } from '../ui/cx.ts';
import { words } from '../words/words.ts';
import { cellName, rowName } from './cellName.ts';
import { deskOf, rangeOf } from './desk.ts';
import { keysOfFrame } from './groupTimes.ts';
import { selectRow } from './looking.ts';
import { scaleAt } from './positions.ts';
import type { PlacedRow } from './rows.ts';
import { keysInRow, keyY, sceneOf, within, type Scene } from './scene.ts';
import type { Sizes } from './sizes.ts';
import { seenSpan, xOf } from './timeScale.ts';
import type { SeenDesk } from './useDesk.ts';
import styles from './Rows.module.css';

/** With more keys in sight only the cursor's row has cells, near the cursor. */
const MOST_CELLS = 150;
const BESIDE_CURSOR = 20;
const CELL_PX = 18;

export interface RowsProps {
  readonly desk: SeenDesk;
  readonly sizes: Sizes;
  readonly id: string;
  openRowMenu(row: string, button: HTMLElement): void;
}

export const cellId = (grid: string, row: string, frameId: number | null): string =>
  `${grid} ${row} ${frameId ?? ''}`.replaceAll(' ', '-');

export function Rows({ desk, sizes, id, openRowMenu }: RowsProps) {
  const scene = sceneOf({ ...desk, state: { ...desk.state, playheadMs: 0 } }, sizes);
  const placed = [scene.all, ...scene.rows];
  const cells = placed.map((row) => keysInSight(scene, row));
  const isDense = cells.reduce((sum, keys) => sum + keys.length, 0) > MOST_CELLS;
  return placed.map((row, index) => (
    <div
      key={row.row.id}
      id={cellId(id, row.row.id, null)}
      role="row"
      aria-rowindex={desk.rows.findIndex(({ id: rowId }) => rowId === row.row.id) + 1}
      className={cx(styles.row, row === scene.all && styles.all)}
      style={{ top: row.top, height: row.height }}
    >
      <Head desk={desk} placed={row} openRowMenu={openRowMenu} />
      {(isDense ? nearCursor(desk, row, cells[index] ?? []) : (cells[index] ?? [])).map((key) => (
        <div
          key={key.frameId}
          id={cellId(id, row.row.id, key.frameId)}
          role="gridcell"
          aria-colindex={(desk.times.places.get(key.frameId) ?? 0) + 1}
          aria-selected={isSelected(desk, row, key.frameId)}
          aria-label={cellName(desk, { row: row.row.id, frameId: key.frameId })}
          className={styles.cell}
          style={{
            insetInlineStart: `calc(var(--heads) + ${xOf(desk.state.time, key.atMs) - CELL_PX / 2}px)`,
            top: keyY(row, key.position, desk.family) - row.top - CELL_PX / 2,
          }}
        />
      ))}
    </div>
  ));
}

function keysInSight(scene: Scene, row: PlacedRow) {
  const keys = keysInRow(row, scene.times);
  const { fromMs, toMs } = seenSpan(scene.state.time, scene.widthPx);
  const [from, to] = within(keys, fromMs, toMs);
  return keys.slice(from, to).filter(({ atMs }) => atMs >= fromMs && atMs <= toMs);
}

function nearCursor<Key extends { readonly frameId: number }>(
  { state: { cursor } }: SeenDesk,
  { row }: PlacedRow,
  keys: readonly Key[],
): readonly Key[] {
  if (row.id !== cursor.row) return [];
  const index = keys.findIndex(({ frameId }) => frameId === cursor.frameId);
  return keys.slice(Math.max(0, index - BESIDE_CURSOR), Math.max(0, index) + BESIDE_CURSOR);
}

function isSelected({ times, state }: SeenDesk, { row }: PlacedRow, frameId: number): boolean {
  const keys = keysOfFrame(times, row.servos, frameId);
  return keys.length > 0 && keys.every((key) => state.selected.has(keyName(key)));
}

interface HeadProps {
  readonly desk: SeenDesk;
  readonly placed: PlacedRow;
  openRowMenu(row: string, button: HTMLElement): void;
}

function Head({ desk, placed: { row }, openRowMenu }: HeadProps) {
  const stores = useStores();
  const { servoView, state } = desk;
  const name = rowName(row);
  const [servo = -1] = row.servos;
  return (
    <div role="rowheader" className={cx(styles.head, state.cursor.row === row.id && styles.atCursor)}>
      {row.kind === 'limb' && (
        <Fold
          limb={row.name}
          name={name}
          count={row.servos.length}
          isFolded={servoView.folded.includes(row.name)}
        />
      )}
      <button
        type="button"
        tabIndex={-1}
        className={cx(styles.name, row.kind !== 'servo' && styles.summary)}
        aria-label={words.timeline.rows.select(name)}
        onClick={(event) =>
          selectRow(
            deskOf(stores),
            row.id,
            event.ctrlKey || event.metaKey ? 'toggles' : event.shiftKey ? 'adds' : 'replaces',
          )
        }
      >
        {name}
      </button>
      {row.kind === 'servo' && (
        <>
          <Marks isLocked={isHeld(servoView, servo)} isMuted={isSilent(servoView, servo)} />
          <span className={styles.value} data-value={servo} aria-hidden="true" />
        </>
      )}
      {row.kind !== 'all' && (
        <button
          type="button"
          tabIndex={-1}
          className={styles.tools}
          aria-label={words.timeline.rows.tools(name)}
          onClick={(event) => openRowMenu(row.id, event.currentTarget)}
        >
          <Icon name="more" />
        </button>
      )}
      {row.kind === 'servo' && state.isTall && <Axis desk={desk} servo={servo} />}
    </div>
  );
}

/** What the upper and the lower edge of a tall row stand for. */
function Axis({ desk, servo }: { readonly desk: SeenDesk; readonly servo: number }) {
  const { min, max } = rangeOf(desk, servo);
  const { text } = scaleAt(desk, servo);
  return (
    <span className={styles.axis} aria-hidden="true">
      <span>{text(max)}</span>
      <span>{text(min)}</span>
    </span>
  );
}

function Fold(props: {
  readonly limb: string;
  readonly name: string;
  readonly count: number;
  readonly isFolded: boolean;
}) {
  const stores = useStores();
  return (
    <button
      type="button"
      tabIndex={-1}
      className={styles.fold}
      aria-expanded={!props.isFolded}
      aria-label={words.timeline.rows.fold(props.name, props.count)}
      onClick={() =>
        editServoView(stores, (view) => ({ ...view, folded: toggled(view.folded, [props.limb]) }))
      }
    >
      <Icon name={props.isFolded ? 'later' : 'down'} />
    </button>
  );
}

const Marks = memo(function Marks({
  isLocked,
  isMuted,
}: {
  readonly isLocked: boolean;
  readonly isMuted: boolean;
}) {
  return (
    <span className={styles.marks}>
      {isLocked && (
        <span role="img" aria-label={words.timeline.rows.locked}>
          <Icon name="lock" />
        </span>
      )}
      {isMuted && (
        <span role="img" aria-label={words.timeline.rows.muted}>
          <Icon name="mute" />
        </span>
      )}
    </span>
  );
});
