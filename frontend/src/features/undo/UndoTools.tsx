// Buttons for undo and redo of a history, each named after its step. Knows no particular history.

import type { StoreApi } from 'zustand';
import { redoLabel, undoLabel, type History } from '#shared/document/history.ts';
import { words } from '../../i18n/words.ts';
import { useInFrame } from '../../ui/useEachFrame.ts';
import { IconButton } from '../../ui/Button.tsx';

export interface UndoToolsProps {
  readonly of: {
    readonly store: Pick<StoreApi<History<unknown>>, 'getState' | 'getInitialState' | 'subscribe'>;
    undo(): void;
    redo(): void;
  };
}

export function UndoTools({ of }: UndoToolsProps) {
  const back = useInFrame(of.store, undoLabel);
  const forth = useInFrame(of.store, redoLabel);
  return (
    <>
      <IconButton
        icon="undo"
        label={back === null ? words.actions.undo : words.actions.undoStep({ label: back })}
        isDisabled={back === null}
        onPress={() => of.undo()}
      />
      <IconButton
        icon="redo"
        label={forth === null ? words.actions.redo : words.actions.redoStep({ label: forth })}
        isDisabled={forth === null}
        onPress={() => of.redo()}
      />
    </>
  );
}
