// Erases every slot, after a dialog that names what is lost.

import { motionHindrance } from '../stores/readiness.ts';
import { useDevice, useSnapshot, useStores } from '../stores/stores.ts';
import { Confirm } from '../ui/Confirm.tsx';
import { words } from '../words/words.ts';

export function EraseControl() {
  const { device } = useStores();
  const { min, max } = useDevice((state) => state.family.slot);
  const mayErase = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && snapshot.activity.kind === 'idle',
  );
  return (
    <Confirm
      tone="quiet"
      icon="erase"
      isDisabled={!mayErase}
      label={words.board.erase}
      title={words.board.eraseTitle}
      text={words.board.eraseText(max - min + 1)}
      keepLabel={words.board.eraseKeep}
      confirmLabel={words.board.eraseConfirm}
      closeLabel={words.close}
      onConfirm={() => device.erase()}
    />
  );
}
