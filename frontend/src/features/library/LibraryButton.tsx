// The way to the library, beside the name of the group that is open.

import { useStores } from '../stores.ts';
import { IconButton } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';

export function LibraryButton() {
  const { view } = useStores();
  return (
    <IconButton
      icon="library"
      label={words.library.button}
      aria-haspopup="dialog"
      onPress={() => view.setState({ libraryOpen: true })}
    />
  );
}
