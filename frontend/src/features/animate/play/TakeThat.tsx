// The key that keeps the last two minutes, whatever is written on now: the hand that moved the robot may be on poses or a pad. What
// was recorded, by this key or on purpose, is asked about here.

import { useEffect, useEffectEvent } from 'react';
import { useStore } from 'zustand';
import type { Sample } from '#shared/group/simplify.ts';
import { useStores } from '../../stores.ts';
import { words } from '../../../i18n/words.ts';
import { Dialog } from '../../../ui/Dialog.tsx';
import { laterComponent } from '../../../ui/later.tsx';
import type { TakeProps } from './Take.tsx';
import { isTextField } from '../../../ui/inputEvents.ts';

// What was recorded is offered to become keys; where nothing moved, that is said.

export function useOffer(): (samples: readonly Sample[]) => void {
  const { notices, tape } = useStores();
  return (taken) => {
    if (taken.length === 0) notices.tell('info', words.record.nothing);
    tape.store.setState({ taken });
  };
}

// The dialog about what was recorded; what stands in it comes when it is wanted.

const Take = laterComponent(async () => (await import('./Take.tsx')).Take, '160px');

/** Without samples it is closed. */
function TakeDialog({ samples, onClose }: TakeProps) {
  return (
    <Dialog title={words.record.title} closeLabel={words.close} isOpen={samples.length > 0} onClose={onClose}>
      <Take samples={samples} onClose={onClose} />
    </Dialog>
  );
}

const TAKE_KEY = 't';
/** Letters mean other things there. */
const OTHERS = '[role=dialog], [role=alertdialog], [role=menu]';

export function TakeThat() {
  const { tape } = useStores();
  const offer = useOffer();
  const taken = useStore(tape.store, (state) => state.taken);
  useKey(TAKE_KEY, () => offer(tape.takeThat()));
  return <TakeDialog samples={taken} onClose={() => tape.store.setState({ taken: [] })} />;
}

/** A plain key, anywhere but where one writes or chooses. */
function useKey(wanted: string, pressed: () => void): void {
  const press = useEffectEvent((event: KeyboardEvent) => {
    const { target } = event;
    const isPlain = !event.ctrlKey && !event.metaKey && !event.altKey && !event.repeat;
    const isForOthers = isTextField(target) || (target instanceof Element && target.closest(OTHERS) !== null);
    if (event.key.toLowerCase() === wanted && isPlain && !isForOthers) pressed();
  });
  useEffect(() => {
    const listen = (event: KeyboardEvent): void => press(event);
    window.addEventListener('keydown', listen);
    return () => window.removeEventListener('keydown', listen);
  }, []);
}
