// Erases every slot, after a dialog that names what is lost, and what of it can come back.

import { startHindrance } from '../stores/device/readiness.ts';
import { useDevice, useSlots, useSnapshot, useStores } from '../stores/stores.ts';
import { Confirm } from '../ui/Confirm.tsx';
import { words } from '../words/words.ts';

export function EraseControl() {
  const { slots } = useStores();
  const held = useSlots((state) => state.book.stored);
  const versions = useSnapshot((snapshot) => snapshot.slotVersions) ?? {};
  const ofOthers = Object.entries(versions)
    .map(([slot, stored]) => ({ slot: Number(slot), name: stored?.name ?? '' }))
    .filter(({ slot }) => held.every((record) => record.slot !== slot));
  const { min, max } = useDevice((state) => state.family.slot);
  const mayErase = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  return (
    <Confirm
      tone="quiet"
      icon="erase"
      isDisabled={!mayErase}
      label={words.board.erase}
      title={words.board.eraseTitle}
      text={[
        words.board.eraseText(max - min + 1),
        ...(held.length > 0 ? [words.slots.willGo(held)] : []),
        ...(ofOthers.length > 0 ? [words.slots.ofOthersWillGo(ofOthers)] : []),
      ].join(' ')}
      keepLabel={words.board.eraseKeep}
      confirmLabel={words.board.eraseConfirm}
      closeLabel={words.close}
      onConfirm={() => slots.erase()}
    />
  );
}
