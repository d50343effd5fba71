// Opens the map of the board's slots.

import { useState } from 'react';
import { useDevice } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { words } from '../words/words.ts';
import { SeveralGroups } from './SeveralGroups.tsx';
import { SlotDetails } from './SlotDetails.tsx';
import { SlotMap } from './SlotMap.tsx';
import styles from './Slots.module.css';

export function SlotsControl() {
  const [isOpen, setOpen] = useState(false);
  return (
    <>
      <Button tone="quiet" icon="buttons" onPress={() => setOpen(true)}>
        {words.slots.open}
      </Button>
      <Dialog
        full
        title={words.slots.title}
        closeLabel={words.close}
        isOpen={isOpen}
        onClose={() => setOpen(false)}
      >
        <SlotBoard />
      </Dialog>
    </>
  );
}

export function SlotBoard({ isSeveralFirst = false }: { readonly isSeveralFirst?: boolean }) {
  const [isSeveral, setSeveral] = useState(isSeveralFirst);
  const canDownload = useDevice((state) => state.family.commands.includes('download'));
  return (
    <>
      <p className={styles.intro}>{words.slots.intro}</p>
      <div className={styles.sides}>
        <SlotMap />
        {isSeveral && canDownload ? (
          <SeveralGroups onBack={() => setSeveral(false)} />
        ) : (
          <SlotDetails onSeveral={canDownload ? () => setSeveral(true) : null} />
        )}
      </div>
    </>
  );
}
