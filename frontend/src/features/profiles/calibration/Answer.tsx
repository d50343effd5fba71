// A button that answers the question of a step. The next step's buttons stand where the last one's were, so that a hand need not
// look for them: the second half of a double press would answer a question that nobody has read, and set home at an end. A mouse
// says itself that it is pressed twice; a finger is not taken at its word before it could have read; a key has nothing to press,
// because the question has the focus (Ask).

import { useLayoutEffect, useRef, type ReactNode, useState, type MouseEvent } from 'react';
import { useStores } from '../../stores.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import styles from './CalibrationWizard.module.css';

// What is asked of the person now. A step that ends takes its buttons away: the focus goes to the next question
// instead of nowhere, and never straight to what moves the servo.

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

/** Systems take two presses for a double one up to then. */
const READ_MS = 500;

interface AnswerProps extends Omit<ButtonProps, 'onPress'> {
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
