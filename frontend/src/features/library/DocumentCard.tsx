// One group of the library: its picture opens it, and more about it unfolds in place.

import { useStore } from 'zustand';
import { memo, type Ref } from 'react';
import type { GroupFacts } from '#shared/files/factsSchema.ts';
import { familyOfUnit } from '#shared/profile/units.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import type { Listed } from '#shared/files/documentStore.ts';
import { BarThumb, RobotThumb } from '../picture/PoseThumb.tsx';
import { useStores, useLibrary } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import { DocumentDetails } from './DocumentDetails.tsx';
import styles from './Library.module.css';

// The picture of a group: its robot in the pose of the middle frame, or bars where that robot is not known here.

function DocumentThumb({ facts }: { readonly facts: GroupFacts }) {
  const { robots } = useStores();
  const robot = useStore(
    robots.store,
    ({ present }) => present.own.find((one) => one.robot.name === facts.robot)?.robot,
  );
  const pose = new Map(facts.pose.map(({ servo, position }) => [servo, position]));
  const isFitting = robot !== undefined && FAMILIES[robot.board].unit === facts.unit;
  const rest = { pose, changed: [...pose.keys()], family: familyOfUnit(facts.unit) };
  return isFitting ? (
    <RobotThumb {...rest} robot={robot} family={FAMILIES[robot.board]} />
  ) : (
    <BarThumb {...rest} />
  );
}

interface DocumentCardProps {
  /** Where its height stands for that of its row. */
  readonly ref?: Ref<HTMLLIElement>;
  readonly row: number;
  /** In the whole list of `count`, from 1: not all of them are drawn. */
  readonly place: number;
  readonly count: number;
  readonly document: Listed;
  readonly nowMs: number;
  readonly isUnfolded: boolean;
  onUnfold(id: string, isUnfolded: boolean): void;
  onDone(): void;
}

/** Drawn again only where it is another: the list is looked at every few seconds. */
export const DocumentCard = memo(function DocumentCard({
  ref,
  row,
  place,
  count,
  document,
  nowMs,
  isUnfolded,
  onUnfold,
  onDone,
}: DocumentCardProps) {
  const { library } = useStores();
  const { id, facts, isRemoved } = document;
  const isOpen = useLibrary((state) => state.openId === id);
  const { name, frames, durationMs, robot, tags } = facts;
  const open = (): void => void library.open(id).then(onDone);
  return (
    <li
      ref={ref}
      data-index={row}
      data-document={id}
      aria-posinset={place}
      aria-setsize={count}
      className={cx(styles.card, isUnfolded && styles.unfolded, isOpen && styles.current)}
    >
      <div className={styles.front}>
        <button
          type="button"
          data-card-face=""
          className={styles.face}
          aria-label={words.library.open({ name })}
          aria-current={isOpen}
          disabled={isRemoved}
          onClick={open}
        >
          <DocumentThumb facts={facts} />
        </button>
        <div className={styles.foot}>
          <span className={styles.name}>{name}</span>
          {isRemoved ? (
            <Button onPress={() => void library.restore(id)}>{words.library.restore}</Button>
          ) : (
            <IconButton
              icon="more"
              label={words.library.more({ name })}
              aria-expanded={isUnfolded}
              onPress={() => onUnfold(id, !isUnfolded)}
            />
          )}
          <span className={styles.about}>
            {isOpen ? words.library.isOpen : words.dates.formatLongAge(nowMs - facts.updatedAtMs)}
          </span>
          <span className={styles.about}>{words.library.about({ count: frames, durationMs })}</span>
          <span className={styles.about}>{[robot, ...tags].filter((word) => word !== '').join(' · ')}</span>
        </div>
      </div>
      {isUnfolded && !isRemoved && <DocumentDetails document={document} onDone={onDone} />}
    </li>
  );
});
