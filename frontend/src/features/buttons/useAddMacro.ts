// A new button at the end of the page, open to be filled.

import { addMacro } from '#shared/profile/macroEdits.ts';
import { useStores } from '../stores.ts';
import { words } from '../../i18n/whole.ts';

export function useAddMacro(): () => void {
  const { macros, view } = useStores();
  return () => {
    const { nextId } = macros.store.getState().present;
    const name = words.macros.newName({ number: nextId });
    macros.edit(
      () => words.macros.edits.add({ name }),
      (page) => addMacro(page, name, []),
    );
    view.setState({ selectedButton: nextId, editsButtons: true });
  };
}
