// Opens the map of the board's slots.

import { useState } from 'react';
import { Button } from '../../../ui/Button.tsx';
import { Dialog } from '../../../ui/Dialog.tsx';
import { laterComponent } from '../../../ui/later.tsx';
import { words } from '../../../i18n/whole.ts';

const SlotBoard = laterComponent(async () => (await import('./SlotBoard.tsx')).SlotBoard, '60vh');

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
