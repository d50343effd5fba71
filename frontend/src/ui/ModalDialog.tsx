// An open dialog of react-aria: traps the focus and restores it, and makes the page behind inert, except STOP in the top layer
// (StopButton).

import type { ReactNode } from 'react';
import { Dialog as AriaDialog, Heading } from 'react-aria-components/Dialog';
import { Modal, ModalOverlay } from 'react-aria-components/Modal';
import { IconButton } from './Button.tsx';
import { cx } from './cx.ts';
import { InLanguage } from './InLanguage.tsx';
import styles from './Dialog.module.css';

export interface DialogProps {
  readonly title: string;
  readonly closeLabel: string;
  readonly isOpen: boolean;
  readonly role?: 'dialog' | 'alertdialog';
  readonly wide?: boolean;
  /** As wide as the window, for work rather than a decision. */
  readonly full?: boolean;
  readonly children: ReactNode;
  onClose(): void;
}

export function ModalDialog({
  title,
  closeLabel,
  isOpen,
  role = 'dialog',
  wide = false,
  full = false,
  children,
  onClose,
}: DialogProps) {
  return (
    <InLanguage>
      <ModalOverlay
        className={styles.veil ?? ''}
        isOpen={isOpen}
        isDismissable={role === 'dialog'}
        onOpenChange={(open) => {
          if (!open) onClose();
        }}
      >
        <Modal className={cx(styles.modal, wide && styles.wide, full && styles.full)}>
          <AriaDialog className={styles.dialog ?? ''} role={role}>
            <div className={styles.header}>
              <Heading slot="title" level={2} className={styles.title ?? ''}>
                {title}
              </Heading>
              <IconButton icon="close" label={closeLabel} onPress={onClose} />
            </div>
            {children}
          </AriaDialog>
        </Modal>
      </ModalOverlay>
    </InLanguage>
  );
}
