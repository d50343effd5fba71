// Erases every slot, after a dialog that names what is lost.

import { useState } from 'react';
import { motionHindrance } from '../stores/readiness.ts';
import { useDevice, useSnapshot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { words } from '../words/en.ts';
import styles from './BoardPanel.module.css';

export function EraseControl() {
  const { device } = useStores();
  const [isAsking, setAsking] = useState(false);
  const { min, max } = useDevice((state) => state.family.slot);
  const mayErase = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && snapshot.activity.kind === 'idle',
  );
  const close = (): void => setAsking(false);
  return (
    <>
      <Button tone="quiet" icon="erase" isDisabled={!mayErase} onPress={() => setAsking(true)}>
        {words.board.erase}
      </Button>
      <Dialog
        role="alertdialog"
        title={words.board.eraseTitle}
        closeLabel={words.close}
        isOpen={isAsking}
        onClose={close}
      >
        <p className={styles.dialogText}>{words.board.eraseText(max - min + 1)}</p>
        <div className={styles.dialogActions}>
          <Button autoFocus onPress={close}>
            {words.board.eraseKeep}
          </Button>
          <Button
            tone="danger"
            icon="erase"
            onPress={() => {
              close();
              device.erase();
            }}
          >
            {words.board.eraseConfirm}
          </Button>
        </div>
      </Dialog>
    </>
  );
}
