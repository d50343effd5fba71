// The dialog of the library.

import { useStores, useView } from '../stores.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/words.ts';

const LibraryView = laterComponent(async () => (await import('./LibraryView.tsx')).LibraryView, '60vh');

export function LibraryDialog() {
  const { view } = useStores();
  const isOpen = useView((state) => state.libraryOpen);
  const close = (): void => view.setState({ libraryOpen: false });
  return (
    <Dialog full title={words.library.title} closeLabel={words.close} isOpen={isOpen} onClose={close}>
      <LibraryView onDone={close} />
    </Dialog>
  );
}
