// Erases every slot, after a dialog that names what is lost, and what of it can come back.

import { notRestored } from '#shared/group/slotBook.ts';
import { startHindrance } from '../../robot/readiness.ts';
import { useDevice, useSlots, useSnapshot, useStores } from '../stores.ts';
import { Confirm } from '../../ui/Confirm.tsx';
import { words } from '../../i18n/whole.ts';

export function EraseControl() {
  const { slots } = useStores();
  const book = useSlots((state) => state.book);
  const versions = useSnapshot((snapshot) => snapshot.slotVersions) ?? {};
  const broken = useSnapshot((snapshot) => snapshot.brokenSlots);
  const held = book.stored;
  const lost = notRestored(book, { versions, broken });
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
        words.board.eraseText({ slots: max - min + 1 }),
        ...(held.length > 0 ? [words.slots.willGo({ groups: namesOf(held) })] : []),
        ...(lost.length > 0 ? [words.slots.notRestored({ groups: namesOf(lost) })] : []),
      ].join(' ')}
      keepLabel={words.board.eraseKeep}
      confirmLabel={words.board.eraseConfirm}
      closeLabel={words.close}
      onConfirm={() => slots.erase()}
    />
  );
}

function namesOf(groups: readonly { readonly slot: number; readonly name: string }[]): string {
  const { formatNames, formatWhole } = words.numbers;
  return formatNames(groups.map(({ slot, name }) => `${formatWhole(slot)} ${name}`.trim()));
}
