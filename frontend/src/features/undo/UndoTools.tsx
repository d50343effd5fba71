// Buttons for undo and redo of a history, each named after its step. Knows no particular history.

import { redoLabel, undoLabel } from '#shared/document/history.ts';
import { ActionIconButton } from '../../ui/Button.tsx';
import { useInFrame } from '../../ui/useInFrame.ts';
import { UNDO_ACTIONS, type Written } from './undoActions.ts';

export function UndoTools({ of }: { readonly of: Written }) {
  useInFrame(of.store, undoLabel);
  useInFrame(of.store, redoLabel);
  return UNDO_ACTIONS.map((action) => (
    <ActionIconButton key={action.id} action={action} shown={of} context={() => of} />
  ));
}
