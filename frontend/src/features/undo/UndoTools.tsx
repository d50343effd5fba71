// Undo and redo of one history, each named after its step, and their buttons. Knows no particular history.

import type { StoreApi } from 'zustand';
import { redoLabel, undoLabel, type History } from '#shared/document/history.ts';
import type { Action } from '../../ui/action.ts';
import { ActionIconButton } from '../../ui/Button.tsx';
import { useInFrame } from '../../ui/useInFrame.ts';
import { words } from '../../i18n/words.ts';

export interface Written {
  readonly store: Pick<StoreApi<History<unknown>>, 'getState' | 'getInitialState' | 'subscribe'>;
  undo(): void;
  redo(): void;
}

const backIn = ({ store }: Written): string | null => undoLabel(store.getState());
const forthIn = ({ store }: Written): string | null => redoLabel(store.getState());

export const UNDO: Action<Written> = {
  ...{ id: 'undo', icon: 'undo', keys: ['Ctrl+z'] },
  label(written) {
    const label = backIn(written);
    return label === null ? words.actions.undo : words.actions.undoStep({ label });
  },
  enabled: (written) => backIn(written) !== null || words.actions.nothingToUndo,
  run: (written) => written.undo(),
};

export const REDO: Action<Written> = {
  ...{ id: 'redo', icon: 'redo', keys: ['Ctrl+Shift+z', 'Ctrl+y'] },
  label(written) {
    const label = forthIn(written);
    return label === null ? words.actions.redo : words.actions.redoStep({ label });
  },
  enabled: (written) => forthIn(written) !== null || words.actions.nothingToRedo,
  run: (written) => written.redo(),
};

export const UNDO_ACTIONS: readonly Action<Written>[] = [UNDO, REDO];

export function UndoTools({ of }: { readonly of: Written }) {
  useInFrame(of.store, undoLabel);
  useInFrame(of.store, redoLabel);
  return UNDO_ACTIONS.map((action) => (
    <ActionIconButton key={action.id} action={action} shown={of} context={() => of} />
  ));
}
