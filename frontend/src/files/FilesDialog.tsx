// The dialog about files; what stands in it comes when it is wanted.

import { Dialog } from '../ui/Dialog.tsx';
import { laterComponent } from '../ui/later.tsx';
import { words } from '../words/words.ts';
import type { FilesContentProps } from './FilesContent.tsx';

const FilesContent = laterComponent(async () => (await import('./FilesContent.tsx')).FilesContent, '40vh');

interface FilesDialogProps extends FilesContentProps {
  readonly isOpen: boolean;
  onClose(): void;
}

export function FilesDialog({ isOpen, onClose, ...content }: FilesDialogProps) {
  return (
    <Dialog title={words.files.title} closeLabel={words.close} wide isOpen={isOpen} onClose={onClose}>
      <FilesContent {...content} />
    </Dialog>
  );
}
