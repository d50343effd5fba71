// A button that lets a person choose files on this computer.

import { useRef } from 'react';
import { Button, type ButtonProps } from './Button.tsx';

interface FileButtonProps extends Pick<ButtonProps, 'children'> {
  /** As of an input for files; without it, of any kind. */
  readonly accept?: string;
  readonly multiple?: boolean;
  onChoose(files: readonly File[]): void;
}

export function FileButton({ children, onChoose, ...kind }: FileButtonProps) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <Button icon="upload" onPress={() => input.current?.click()}>
        {children}
      </Button>
      <input
        {...kind}
        ref={input}
        type="file"
        hidden
        onChange={({ currentTarget }) => {
          onChoose([...(currentTarget.files ?? [])]);
          // The same file may be chosen again.
          currentTarget.value = '';
        }}
      />
    </>
  );
}
