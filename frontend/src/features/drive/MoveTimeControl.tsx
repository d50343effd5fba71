// How long a move from the sliders takes: following the hand, or a set time.

import { useState } from 'react';
import { useDevice, useStores, useView } from '../stores.ts';
import { NumberField } from '../../ui/NumberField.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/words.ts';
import { SendRate } from './SendRate.tsx';
import styles from './MoveTimeControl.module.css';

const USUAL_MS = 1000;

export function MoveTimeControl() {
  const { view, notices } = useStores();
  const moveTime = useView((state) => state.moveTime);
  const { min, max } = useDevice((state) => state.family.durationMs);
  const [lastMs, setLastMs] = useState(USUAL_MS);
  const isTimed = moveTime !== 'hand';
  const setMs = (durationMs: number): void => {
    setLastMs(durationMs);
    view.setState({ moveTime: durationMs });
  };
  return (
    <div className={styles.control}>
      <span className={styles.label} aria-hidden="true">
        {words.servos.moveTime}
        <SendRate />
      </span>
      <Choice
        label={words.servos.moveTime}
        value={isTimed ? 'timed' : 'hand'}
        options={(['hand', 'timed'] as const).map((value) => ({
          value,
          label: words.servos.moveTimes[value],
        }))}
        onChange={(choice) => view.setState({ moveTime: choice === 'hand' ? 'hand' : lastMs })}
      />
      <NumberField
        label={words.servos.moveTimeField}
        value={isTimed ? moveTime : lastMs}
        min={min}
        max={max}
        step={100}
        unit={words.servos.ms}
        isDisabled={!isTimed}
        onChange={setMs}
        onRefused={(value) => notices.refuse(words.refused({ name: words.servos.moveTime, value, min, max }))}
      />
      <p className={styles.about}>{words.servos.moveTimeAbout[isTimed ? 'timed' : 'hand']}</p>
    </div>
  );
}
