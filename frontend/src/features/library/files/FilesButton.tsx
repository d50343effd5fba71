// Opens the dialog about files, and says how many wait in it.

import { Button } from '../../../ui/Button.tsx';
import { filesText } from './fileText.ts';
import { useFiles } from './FilesArea.tsx';

export function FilesButton() {
  const { counts, show } = useFiles();
  return (
    <Button tone="quiet" icon="file" onPress={show}>
      {filesText(counts)}
    </Button>
  );
}
