// Opens the dialog about files, and says how many wait in it.

import { Button } from '../ui/Button.tsx';
import { words } from '../words/whole.ts';
import { useFiles } from './FilesArea.tsx';

export function FilesButton() {
  const { counts, show } = useFiles();
  return (
    <Button tone="quiet" icon="file" onPress={show}>
      {words.files.button(counts.opened, counts.refused)}
    </Button>
  );
}
