// Keeping the last two minutes, whatever is written on now: they may have been moved by poses or a pad. What was recorded, by this or
// on purpose, is confirmed here.

import { useStore } from 'zustand';
import type { Sample } from '#shared/group/simplify.ts';
import { useStores, type Stores } from '../../stores.ts';
import type { Action } from '../../../ui/action.ts';
import { words } from '../../../i18n/words.ts';
import { Dialog } from '../../../ui/Dialog.tsx';
import { laterComponent } from '../../../ui/later.tsx';

// What was recorded is offered to become keys; where nothing moved, that is said.

export function offer({ notices, tape }: Pick<Stores, 'notices' | 'tape'>, taken: readonly Sample[]): void {
  if (taken.length === 0) notices.show('info', words.record.nothing);
  tape.store.setState({ taken });
}

export const KEEP_LAST: Action<Pick<Stores, 'notices' | 'tape'>> = {
  ...{ id: 'keepLast', icon: 'record', keys: ['t'] },
  label: () => words.record.takeThat,
  enabled: () => true,
  run: (stores) => offer(stores, stores.tape.takeThat()),
};

// The dialog about what was recorded; what stands in it comes when it is wanted.

const Take = laterComponent(async () => (await import('./Take.tsx')).Take, '160px');

/** Without samples it is closed. */
export function TakeDialog() {
  const { tape } = useStores();
  const samples = useStore(tape.store, (state) => state.taken);
  const close = (): void => tape.store.setState({ taken: [] });
  return (
    <Dialog title={words.record.title} closeLabel={words.close} isOpen={samples.length > 0} onClose={close}>
      <Take samples={samples} onClose={close} />
    </Dialog>
  );
}
