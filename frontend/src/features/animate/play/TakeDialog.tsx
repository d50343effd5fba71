// Keeping the last two minutes, whatever is written on now: they may have been moved by poses or a pad. What was recorded, by this or
// on purpose, is confirmed here.

import { useStore } from 'zustand';
import type { Sample } from '#shared/group/simplify.ts';
import { recorded } from '../../servoView.ts';
import { servoViewOf, useStores, type Stores } from '../../stores.ts';
import type { Action } from '../../../ui/action.ts';
import { words } from '../../../i18n/words.ts';
import { Dialog } from '../../../ui/Dialog.tsx';
import { laterComponent } from '../../../ui/later.tsx';

// What was recorded is offered to become keys; where nothing moved, that is said.

function offer({ notices, tape }: Pick<Stores, 'notices' | 'tape'>, taken: readonly Sample[]): void {
  if (taken.length === 0) notices.show('info', words.record.nothing);
  tape.store.setState({ taken });
}

type RecordingStores = Pick<Stores, 'notices' | 'tape' | 'view' | 'robots' | 'device'>;

export function endRecording(stores: RecordingStores): void {
  const all = stores.robots.current().robot.servos.map(({ servo }) => servo);
  offer(stores, stores.tape.end(recorded(servoViewOf(stores), all).servos));
}

/** STOP ends what is recorded on purpose, from wherever it comes; what was recorded until then is offered as at the end. */
export function endRecordingWithStop(stores: RecordingStores): void {
  const { device, notices, tape } = stores;
  device.store.subscribe(({ snapshot: { latch } }, { snapshot: before }) => {
    const isRecording = tape.store.getState().recordingSinceMs !== null;
    if (latch === null || before.latch !== null || !isRecording) return;
    endRecording(stores);
    if (tape.store.getState().taken.length > 0) notices.show('info', words.record.stopped);
  });
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
