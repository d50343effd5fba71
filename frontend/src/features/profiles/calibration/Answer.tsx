// A button that answers the question of a step. The next step's buttons stand where the last one's were, so that a hand need not
// look for them: the second half of a double press would answer a question that nobody has read, and set home at an end. A mouse
// says itself that it is pressed twice; a finger is not taken at its word before it could have read; a key has nothing to press,
// because the question has the focus (Ask).

import { useState, type MouseEvent } from 'react';
import { useStores } from '../../stores.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import styles from './CalibrationWizard.module.css';

/** Systems take two presses for a double one up to then. */
const READ_MS = 500;

export interface AnswerProps extends Omit<ButtonProps, 'onPress'> {
  onPress(): void;
}

export function Answer({ onPress, ...rest }: AnswerProps) {
  const { clock } = useStores().device;
  const [askedMs] = useState(clock.now);

  function isEcho({ detail, nativeEvent }: MouseEvent): boolean {
    const isFinger = nativeEvent instanceof PointerEvent && nativeEvent.pointerType === 'touch';
    return isFinger ? clock.now() - askedMs < READ_MS : detail > 1;
  }

  return (
    <span className={styles.answer}>
      <Button
        {...rest}
        onPress={(press) => {
          if (!isEcho(press)) onPress();
        }}
      />
    </span>
  );
}
