// Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y (Command on a Mac) for a document, except in text fields, which have their own undo.

import { useEffect } from 'react';
import type { Undoable } from '../../state/undoable.ts';
import { isTextField } from '../../ui/inputEvents.ts';

/** null if the keys do nothing now. */
export function useUndoKeys(document: Pick<Undoable<unknown>, 'undo' | 'redo'> | null): void {
  useEffect(() => {
    const key = (event: KeyboardEvent): void => {
      const action = undoActionOf(event);
      if (action === null || document === null || isTextField(event.target)) return;
      event.preventDefault();
      document[action]();
    };
    window.addEventListener('keydown', key);
    return () => window.removeEventListener('keydown', key);
  }, [document]);
}

export function undoActionOf(
  event: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'shiftKey'>,
): 'undo' | 'redo' | null {
  if (!event.ctrlKey && !event.metaKey) return null;
  const key = event.key.toLowerCase();
  if (key === 'z') return event.shiftKey ? 'redo' : 'undo';
  return key === 'y' ? 'redo' : null;
}
