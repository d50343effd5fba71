// What stands at the left of a row: its name, its position at the playhead, and what is done to it.

import { motionTracks } from '#shared/group/blocks.ts';
import { memo } from 'react';
import { positionAt } from '#shared/group/tracks.ts';
import { MovingLabel } from '../../picture/MovingText.tsx';
import { isHeld, isSilent, toggled } from '../../servoView.ts';
import {
  editServoView,
  groupBoardOf,
  useDocument,
  useGroupBoard,
  useServoView,
  useStores,
  useTimeline,
  useView,
  type Stores,
} from '../../stores.ts';
import { Icon } from '../../../ui/Icon.tsx';
import { cx } from '../../../ui/cx.ts';
import { words } from '../../../i18n/whole.ts';
import { useWords } from '../../../i18n/words.ts';
import { rowName, scaleAt } from './valueText.ts';
import { contextOf, rangeOf, useRowRanges } from './context.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { selectRow } from './looking.ts';
import type { Row } from './rows.ts';
import styles from './Rows.module.css';

export interface RowHeadProps {
  readonly row: Row;
  readonly isAtCursor: boolean;
  openRowMenu(row: string, button: HTMLElement): void;
}

export const RowHead = memo(function RowHead({ row, isAtCursor, openRowMenu }: RowHeadProps) {
  const stores = useStores();
  useWords();
  const name = rowName(row);
  return (
    <div role="rowheader" className={cx(styles.head, isAtCursor && styles.atCursor)}>
      {row.kind === 'limb' && <Fold limb={row.name} name={name} count={row.servos.length} />}
      <button
        type="button"
        tabIndex={-1}
        className={cx(styles.name, row.kind !== 'servo' && styles.summary)}
        aria-label={words.timeline.rows.select({ row: name })}
        onClick={(event) =>
          selectRow(
            contextOf(stores),
            row.id,
            event.ctrlKey || event.metaKey || stores.view.getState().addsToSelection
              ? 'toggles'
              : event.shiftKey
                ? 'adds'
                : 'replaces',
          )
        }
      >
        {name}
      </button>
      {row.kind === 'servo' && (
        <>
          <Marks servo={row.servos[0] ?? -1} />
          <MovingLabel
            isSilent
            className={styles.value}
            title={words.timeline.rows.value}
            colour="ink-dim"
            text={() => valueText(stores, row.servos[0] ?? -1)}
          />
        </>
      )}
      {row.kind !== 'all' && (
        <button
          type="button"
          tabIndex={-1}
          className={styles.tools}
          aria-label={words.timeline.rows.tools({ row: name })}
          onClick={(event) => openRowMenu(row.id, event.currentTarget)}
        >
          <Icon name="more" />
        </button>
      )}
      {row.kind === 'servo' && <Axis servo={row.servos[0] ?? -1} />}
    </div>
  );
});

/** Where the group has the servo at the playhead. */
function valueText(stores: Stores, servo: number): string {
  const { timeline, document, view } = stores;
  const { present: group } = document.store.getState();
  const track = motionTracks(group, timesOf(group).tracks).get(servo);
  const position = track === undefined ? null : positionAt(track, timeline.getState().playheadMs);
  if (position === null) return '';
  const { family, robot } = groupBoardOf(stores);
  const { positionsIn } = view.getState();
  return scaleAt({ group, robot, family, positionsIn }, servo).digits(position);
}

/** What the upper and the lower edge of a tall row, or of one that is open large, stand for. */
function Axis({ servo }: { readonly servo: number }) {
  const isTall = useTimeline((state) => state.isTall);
  const { family, robot } = useGroupBoard();
  const positionsIn = useView((state) => state.positionsIn);
  const unit = useDocument(({ present }) => present.unit);
  const large = useTimeline((state) => (state.large?.servo === servo ? state.large : null));
  const fitted = useRowRanges().get(servo);
  if (!isTall && large === null) return null;
  const { min, max } = large ?? fitted ?? rangeOf({ robot, family }, servo);
  const { text } = scaleAt({ robot, family, positionsIn, group: { unit } }, servo);
  return (
    <span className={styles.axis} aria-hidden="true">
      <span>{text(max)}</span>
      <span>{text(min)}</span>
    </span>
  );
}

function Fold({
  limb,
  name,
  count,
}: {
  readonly limb: string;
  readonly name: string;
  readonly count: number;
}) {
  const stores = useStores();
  const isFolded = useServoView(({ folded }) => folded.includes(limb));
  return (
    <button
      type="button"
      tabIndex={-1}
      className={styles.fold}
      aria-expanded={!isFolded}
      aria-label={words.timeline.rows.fold({ limb: name, count })}
      onClick={() => editServoView(stores, (view) => ({ ...view, folded: toggled(view.folded, [limb]) }))}
    >
      <Icon name={isFolded ? 'later' : 'down'} />
    </button>
  );
}

function Marks({ servo }: { readonly servo: number }) {
  const isLocked = useServoView((view) => isHeld(view, servo));
  const isMuted = useServoView((view) => isSilent(view, servo));
  const isArmed = useServoView(({ armed }) => armed.includes(servo));
  return (
    <span className={styles.marks}>
      {isArmed && (
        <span role="img" aria-label={words.timeline.rows.armed}>
          <Icon name="record" />
        </span>
      )}
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
}
