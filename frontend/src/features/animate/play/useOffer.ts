// What was recorded is offered to become keys; where nothing moved, that is said.

import type { Sample } from '#shared/group/simplify.ts';
import { useStores } from '../../stores.ts';
import { words } from '../../../i18n/words.ts';

export function useOffer(): (samples: readonly Sample[]) => void {
  const { notices, tape } = useStores();
  return (taken) => {
    if (taken.length === 0) notices.tell('info', words.record.nothing);
    tape.store.setState({ taken });
  };
}
