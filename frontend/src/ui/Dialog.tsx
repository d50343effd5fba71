// A dialog over the page. STOP stays within reach. Esc closes the dialog and is STOP at the same time, as everywhere. What holds the
// focus in it is fetched when a dialog is first opened.

import type { ReactNode } from 'react';
import { later, Missing, usePart } from './later.tsx';
import styles from './Dialog.module.css';

export interface DialogProps {
  readonly title: string;
  readonly closeLabel: string;
  readonly isOpen: boolean;
  readonly role?: 'dialog' | 'alertdialog';
  readonly wide?: boolean;
  /** As wide as the window allows, for work rather than a decision. */
  readonly full?: boolean;
  readonly children: ReactNode;
  onClose(): void;
}

const modal = later(async () => (await import('./ModalDialog.tsx')).ModalDialog);

export function Dialog(props: DialogProps) {
  const { part: ModalDialog, isMissing } = usePart(modal, props.isOpen);
  if (ModalDialog !== null) return <ModalDialog {...props} />;
  if (!props.isOpen || !isMissing) return null;
  return (
    <div className={styles.veil}>
      <div className={styles.modal}>
        <Missing part={modal} />
      </div>
    </div>
  );
}
