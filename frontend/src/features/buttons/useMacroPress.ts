// What pressing a button does: it starts, or ends where it is at work already.

import type { Macro } from '#shared/profile/macro.ts';
import { useStores } from '../stores.ts';

export function useMacroPress(): (macro: Macro) => void {
  const { macroRun } = useStores();
  return (macro) => {
    if (macroRun.store.getState()?.macroId === macro.id) macroRun.end();
    else macroRun.start(macro);
  };
}
