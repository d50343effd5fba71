// A button that answers the question of a step. The next step's buttons appear at the same place, so the second half of a double press
// would answer a question that was not read yet. Double clicks of a mouse are ignored, touches within half a second too; keys press
// nothing, because the question has the focus (Ask).

import { useLayoutEffect, useRef, type ReactNode, useState, type MouseEvent } from 'react';
import { useStores } from '../../stores.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import styles from './CalibrationWizard.module.css';

/** The current question. It takes the focus when a step ends and its buttons disappear, so that the focus is not on a button that moves. */
export function Ask({ children }: { readonly children: ReactNode }) {
  const asked = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    if (document.activeElement?.contains(asked.current)) asked.current?.focus();
  }, []);
  return (
    <p ref={asked} className={styles.ask} tabIndex={-1}>
      {children}
    </p>
  );
}

/** The usual limit of systems for a double press. */
const READ_MS = 500;

interface AnswerProps extends Omit<ButtonProps, 'onPress'> {
  onPress(): void;
}

export function Answer({ onPress, ...rest }: AnswerProps) {
  const { clock } = useStores().device;
  const [shownMs] = useState(clock.now);

  function isEcho({ detail, nativeEvent }: MouseEvent): boolean {
    const isFinger = nativeEvent instanceof PointerEvent && nativeEvent.pointerType === 'touch';
    return isFinger ? clock.now() - shownMs < READ_MS : detail > 1;
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
