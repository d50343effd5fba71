// How fast the board plays its groups, in percent, for the chosen slot or every one. Nobody can ask a board for its speed, so
// the field shows what will be set.

import { useState } from 'react';
import { motionHindrance } from '../../robot/readiness.ts';
import { useDevice, useSnapshot, useStores, useSlot } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import field from '../../ui/Field.module.css';
import styles from './BoardPanel.module.css';

const AS_STORED = 100;

export function SpeedControl() {
  const { device, notices } = useStores();
  const slot = useSlot();
  const { min, max } = useDevice((state) => state.family.speedPercent);
  const isAllowed = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const [percent, setPercent] = useState(AS_STORED);
  const [isEverySlot, setEverySlot] = useState(false);
  return (
    <div className={styles.row}>
      <div className={field.named}>
        <span className={styles.label} aria-hidden="true">
          {words.board.speed}
        </span>
        <NumberField
          label={words.board.speedField}
          value={percent}
          min={min}
          max={max}
          step={10}
          unit={words.board.percent}
          onChange={setPercent}
          onRefused={(value) => notices.refuse(words.refused({ name: words.board.speed, value, min, max }))}
        />
      </div>
      <div className={styles.running}>
        <Toggle label={words.board.everySlot} isOn={isEverySlot} onChange={setEverySlot} />
        <Button
          hint={words.board.speedHint}
          isDisabled={!isAllowed}
          onPress={() => device.setSpeed(isEverySlot ? null : slot, percent)}
        >
          {words.board.setSpeed}
        </Button>
      </div>
    </div>
  );
}
