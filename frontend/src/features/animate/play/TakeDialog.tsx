// The dialog about what was recorded; what stands in it comes when it is wanted.

import { Dialog } from '../../../ui/Dialog.tsx';
import { laterComponent } from '../../../ui/later.tsx';
import { words } from '../../../i18n/words.ts';
import type { TakeProps } from './Take.tsx';

const Take = laterComponent(async () => (await import('./Take.tsx')).Take, '160px');

/** Without samples it is closed. */
export function TakeDialog({ samples, onClose }: TakeProps) {
  return (
    <Dialog title={words.record.title} closeLabel={words.close} isOpen={samples.length > 0} onClose={onClose}>
      <Take samples={samples} onClose={onClose} />
    </Dialog>
  );
}
