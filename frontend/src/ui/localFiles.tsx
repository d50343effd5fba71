// Files on this computer: a button or a zone to choose them, and saving a text or bytes as a download of the browser.

import { type DragEvent, type ReactNode, useRef } from 'react';
import { Button, type ButtonProps } from './Button.tsx';
import styles from './localFiles.module.css';

interface FileButtonProps extends Pick<ButtonProps, 'children'> {
  /** As `accept` of a file input; any file if absent. */
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

interface FileZoneProps extends FileButtonProps {
  readonly hint: string;
  /** Below the button. */
  readonly below?: ReactNode;
  /** Files can be dropped here; left out: what is around it takes them. */
  readonly takesDrop?: boolean;
}

/** The place for files from this computer: a button to choose them, and what can be done with them. */
export function FileZone({ hint, below, takesDrop = false, ...button }: FileZoneProps) {
  const drop = (event: DragEvent): void => {
    event.preventDefault();
    button.onChoose([...event.dataTransfer.files]);
  };
  return (
    <div
      className={styles.zone}
      {...(takesDrop && { onDragOver: (event) => event.preventDefault(), onDrop: drop })}
    >
      <FileButton {...button} />
      <span className={styles.hint}>{hint}</span>
      {below}
    </div>
  );
}

/** Lets the person choose a file, in the press of a button or menu. null: none was chosen. */
export function chooseFile(accept: string): Promise<File | null> {
  const input = document.createElement('input');
  Object.assign(input, { type: 'file', accept });
  return new Promise((resolve) => {
    input.addEventListener('change', () => resolve(input.files?.[0] ?? null));
    input.addEventListener('cancel', () => resolve(null));
    input.click();
  });
}

export interface TextFile {
  readonly name: string;
  readonly text: string;
}

export function saveFile({ name, text }: TextFile): void {
  saveBlob(name, new Blob([text], { type: 'text/plain' }));
}

export function saveBlob(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  URL.revokeObjectURL(url);
}
