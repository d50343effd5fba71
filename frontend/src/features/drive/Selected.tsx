// The tools for selected servos: how they move together, locking, and more.

import { motionHindrance } from '../../robot/readiness.ts';
import { isHeld, select, toggled, TOGETHER, type ServoView } from '../servoView.ts';
import { editServoView, useServoView, useSnapshot, useStores } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { CheckedNumber } from '../CheckedNumber.tsx';
import { Select } from '../../ui/Select.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { useLayout } from '../../ui/useLayout.ts';
import { servosText } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { useServoMoves } from './useServoMoves.ts';
import styles from './SelectionBar.module.css';

/** A servo may turn up to twice as far as the others, in either direction. */
const MOST_PERCENT = 200;

interface SelectedProps {
  readonly selected: readonly number[];
}

export function Selected({ selected }: SelectedProps) {
  const isWeighted = useServoView((view) => view.together === 'weighted');
  return (
    <>
      <Tools selected={selected} />
      {selected.length > 1 && isWeighted && <Weights selected={selected} />}
    </>
  );
}

function Tools({ selected }: SelectedProps) {
  const stores = useStores();
  const servoMoves = useServoMoves();
  const cannotMove = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const together = useServoView((view) => view.together);
  const isLocked = useServoView((view) => selected.every((servo) => isHeld(view, servo)));
  const edit = (change: (view: ServoView) => ServoView): void => editServoView(stores, change);
  const isLinked = selected.length > 1;
  const layout = useLayout();
  const isPhone = layout === 'phone';
  // In one line, so that the rows below do not move.
  const Ways = layout === 'desktop' ? Choice : Select;
  const clear = (): void => edit((view) => select(view, []));
  return (
    <div className={styles.line}>
      {isLinked && isPhone ? (
        <IconButton icon="close" label={words.servoPanel.unbind} onPress={clear} />
      ) : (
        <Button tone="quiet" onPress={clear}>
          {isLinked ? words.servoPanel.unbind : words.servoPanel.clear}
        </Button>
      )}
      {isLinked ? (
        <Ways
          label={words.servoPanel.together}
          value={together}
          options={TOGETHER.map((value) => ({ value, label: words.servoPanel.ways[value] }))}
          onChange={(way) => edit((view) => ({ ...view, together: way }))}
        />
      ) : (
        <span className={styles.hint}>{servosText(selected)}</span>
      )}
      <span className={styles.acts}>
        <IconButton
          icon="home"
          label={words.servoPanel.home}
          isDisabled={cannotMove}
          onPress={() => servoMoves.home(selected)}
        />
        <IconButton
          icon="lock"
          label={isLocked ? words.servoPanel.unlock : words.servoPanel.lock}
          onPress={() => edit((view) => (isLocked ? unlocked(view, selected) : locked(view, selected)))}
        />
        <IconButton
          icon="solo"
          label={words.servoPanel.solo}
          onPress={() => edit((view) => ({ ...view, solo: selected, locked: [] }))}
        />
        <IconButton
          icon="hide"
          label={words.servoPanel.hide}
          onPress={() => edit((view) => select({ ...view, hidden: toggled(view.hidden, selected) }, []))}
        />
      </span>
    </div>
  );
}

const locked = (view: ServoView, servos: readonly number[]): ServoView => ({
  ...view,
  locked: [...new Set([...view.locked, ...servos])],
  solo: view.solo.filter((one) => !servos.includes(one)),
});

const unlocked = (view: ServoView, servos: readonly number[]): ServoView => ({
  ...view,
  locked: view.locked.filter((one) => !servos.includes(one)),
  solo: view.solo.length === 0 ? [] : [...new Set([...view.solo, ...servos])],
});

function Weights({ selected }: SelectedProps) {
  const stores = useStores();
  const weights = useServoView((view) => view.weights);
  const set = (servo: number, percent: number): void =>
    editServoView(stores, (view) => ({
      ...view,
      weights: { ...view.weights, [servo]: percent },
    }));
  return (
    <ul className={styles.weights}>
      {selected.map((servo) => (
        <li key={servo} className={styles.weight}>
          <span aria-hidden="true">{words.servos.name({ servo })}</span>
          <CheckedNumber
            label={words.servoPanel.weight({ servo })}
            size="small"
            value={weights[servo] ?? 100}
            min={-MOST_PERCENT}
            max={MOST_PERCENT}
            unit={words.servoPanel.percent}
            onChange={(percent) => set(servo, percent)}
          />
        </li>
      ))}
    </ul>
  );
}
