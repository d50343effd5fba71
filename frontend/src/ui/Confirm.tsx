// The confirmation of an action that cannot be undone: a dialog says what will happen, and Cancel has the focus. With its button, or
// without for callers that open it themselves.

import { useState } from 'react';
import { Button, type ButtonProps } from './Button.tsx';
import { Dialog } from './Dialog.tsx';
import styles from './Confirm.module.css';

type Looks = Pick<ButtonProps, 'icon' | 'isDisabled'>;

interface Question {
  readonly title: string;
  readonly text: string;
  readonly keepLabel: string;
  readonly confirmLabel: string;
  readonly closeLabel: string;
  /** A less destructive alternative. */
  readonly otherwise?: { readonly label: string; onConfirm(): void } | undefined;
  onConfirm(): void;
}

export interface ConfirmProps extends Question, Looks, Pick<ButtonProps, 'tone' | 'hint'> {
  readonly label: string;
}

export function Confirm({ label, tone, hint, ...question }: ConfirmProps) {
  const { icon, isDisabled = false, otherwise } = question;
  const [isAsking, setAsking] = useState(false);
  const closingBefore = (act: () => void) => (): void => {
    setAsking(false);
    act();
  };
  return (
    <>
      <Button
        {...{ isDisabled, ...(tone && { tone }), ...(icon && { icon }), ...(hint !== undefined && { hint }) }}
        onPress={() => setAsking(true)}
      >
        {label}
      </Button>
      <ConfirmDialog
        {...question}
        isOpen={isAsking}
        onClose={() => setAsking(false)}
        otherwise={otherwise && { ...otherwise, onConfirm: closingBefore(otherwise.onConfirm) }}
        onConfirm={closingBefore(question.onConfirm)}
      />
    </>
  );
}

export interface ConfirmDialogProps extends Question, Looks {
  readonly isOpen: boolean;
  /** Cancels. */
  onClose(): void;
}

export function ConfirmDialog({ title, closeLabel, isOpen, ...content }: ConfirmDialogProps) {
  const { onClose } = content;
  return (
    <Dialog role="alertdialog" title={title} closeLabel={closeLabel} isOpen={isOpen} onClose={onClose}>
      <ConfirmContent autoFocus {...content} />
    </Dialog>
  );
}

export type ConfirmContentProps = Omit<ConfirmDialogProps, 'title' | 'closeLabel' | 'isOpen'> & {
  /** Focuses Cancel. */
  readonly autoFocus?: boolean;
};

export function ConfirmContent(props: ConfirmContentProps) {
  const { text, keepLabel, confirmLabel, otherwise, autoFocus = false, onClose, onConfirm, ...looks } = props;
  return (
    <>
      <p className={styles.text}>{text}</p>
      <div className={styles.actions}>
        <Button autoFocus={autoFocus} onPress={onClose}>
          {keepLabel}
        </Button>
        {otherwise && (
          <Button isDisabled={looks.isDisabled ?? false} onPress={otherwise.onConfirm}>
            {otherwise.label}
          </Button>
        )}
        <Button {...looks} tone="danger" onPress={onConfirm}>
          {confirmLabel}
        </Button>
      </div>
    </>
  );
}
