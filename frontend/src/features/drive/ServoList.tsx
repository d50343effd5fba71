// The list of servos, grouped by limb where the robot has limbs. A limb can be folded and selected as a whole.

import { useMemo } from 'react';
import type { RobotServo } from '#shared/profile/robot.ts';
import { limbsOf } from '../picture/pose.ts';
import { SharedSheet } from '../picture/SharedSheet.tsx';
import { select, toggled } from '../servoView.ts';
import { editServoView, useRobot, useServoView, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/words.ts';
import { ServoRow } from './ServoRow.tsx';
import styles from './ServoList.module.css';

/** Rows that fit below the picture; more of them scroll. */
const FIT = 6;

export function ServoList() {
  const { servos } = useRobot();
  const hidden = useServoView((view) => view.hidden);
  const limbs = useMemo(
    () => limbsOf(servos.filter(({ servo }) => !hidden.includes(servo))),
    [servos, hidden],
  );
  const order = useMemo(() => limbs.flatMap((limb) => limb.servos.map(({ servo }) => servo)), [limbs]);
  return (
    <div className={cx(styles.list, servos.length > FIT && styles.scrolling)}>
      <SharedSheet>
        {limbs.map(({ group, servos: members }) =>
          limbs.length === 1 ? (
            <Rows key={group} servos={members} order={order} />
          ) : (
            <Limb key={group} group={group} servos={members} order={order} />
          ),
        )}
      </SharedSheet>
    </div>
  );
}

interface RowsProps {
  readonly servos: readonly RobotServo[];
  readonly order: readonly number[];
}

function Rows({ servos, order }: RowsProps) {
  return (
    <ol>
      {servos.map((servo) => (
        <ServoRow key={servo.servo} servo={servo} order={order} />
      ))}
    </ol>
  );
}

function Limb({ group, servos, order }: RowsProps & { readonly group: string }) {
  const stores = useStores();
  const isFolded = useServoView(({ folded }) => folded.includes(group));
  const name = group === '' ? words.servoPanel.noGroup : group;
  const fold = (): void =>
    editServoView(stores, (view) => ({ ...view, folded: toggled(view.folded, [group]) }));
  const selectAll = (): void =>
    editServoView(stores, (view) =>
      select(
        view,
        toggled(
          view.selected,
          servos.map(({ servo }) => servo),
        ),
      ),
    );
  return (
    <section aria-label={name}>
      <header className={styles.header}>
        <Button
          tone="quiet"
          icon={isFolded ? 'later' : 'down'}
          aria-expanded={!isFolded}
          aria-label={words.servoPanel.fold({ group: name, count: servos.length })}
          onPress={fold}
        >
          {name}
        </Button>
        <Button tone="quiet" aria-label={words.servoPanel.selectGroup({ group: name })} onPress={selectAll}>
          {words.servoPanel.selectShort}
        </Button>
      </header>
      {!isFolded && <Rows servos={servos} order={order} />}
    </section>
  );
}
