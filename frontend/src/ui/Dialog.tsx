// A dialog over the page. STOP stays reachable; Esc closes the dialog and also stops the robot, as everywhere. The code that traps the
// focus is fetched when the first dialog opens.

import { later, Missing, usePart } from './later.tsx';
import type { DialogProps } from './ModalDialog.tsx';
import styles from './Dialog.module.css';

const modal = later(async () => (await import('./ModalDialog.tsx')).ModalDialog, 'guards');

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
