// Puts a text on the system's clipboard and says so; not there on an insecure address, where the browser has no clipboard for pages.

import { Button } from '../../ui/Button.tsx';
import { useStores } from '../stores.ts';

interface CopyButtonProps {
  readonly text: string;
  readonly label: string;
  /** What is said once it is there. */
  readonly done: string;
}

export function CopyButton({ text, label, done }: CopyButtonProps) {
  const { notices } = useStores();
  if (!window.isSecureContext) return null;
  const copy = (): void =>
    void navigator.clipboard.writeText(text).then(() => notices.tell('info', done), notices.tellError);
  return (
    <Button tone="quiet" icon="copy" onPress={copy}>
      {label}
    </Button>
  );
}
