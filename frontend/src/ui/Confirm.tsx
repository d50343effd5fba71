// A button whose deed cannot be taken back: a dialog names what happens before it is done, and the way out is at hand.

import { useState } from 'react';
import { Button, type ButtonProps } from './Button.tsx';
import { Dialog } from './Dialog.tsx';
import styles from './Confirm.module.css';

export interface ConfirmProps extends Pick<ButtonProps, 'tone' | 'icon' | 'hint' | 'isDisabled'> {
  readonly label: string;
  readonly title: string;
  readonly text: string;
  readonly keepLabel: string;
  readonly confirmLabel: string;
  readonly closeLabel: string;
  onConfirm(): void;
}

export function Confirm({ label, title, text, keepLabel, confirmLabel, onConfirm, ...rest }: ConfirmProps) {
  const { closeLabel, hint, ...looks } = rest;
  const [isAsking, setAsking] = useState(false);
  const close = (): void => setAsking(false);
  return (
    <>
      <Button {...looks} {...(hint !== undefined && { hint })} onPress={() => setAsking(true)}>
        {label}
      </Button>
      <Dialog role="alertdialog" title={title} closeLabel={closeLabel} isOpen={isAsking} onClose={close}>
        <p className={styles.text}>{text}</p>
        <div className={styles.actions}>
          <Button autoFocus onPress={close}>
            {keepLabel}
          </Button>
          <Button
            {...looks}
            tone="danger"
            onPress={() => {
              close();
              onConfirm();
            }}
          >
            {confirmLabel}
          </Button>
        </div>
      </Dialog>
    </>
  );
}
