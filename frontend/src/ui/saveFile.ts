// Hands a text or bytes to the person as a file, the browser's way.

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
