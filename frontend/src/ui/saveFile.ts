// Hands a text to the person as a file, the browser's way.

export interface TextFile {
  readonly name: string;
  readonly text: string;
}

export function saveFile({ name, text }: TextFile): void {
  const url = URL.createObjectURL(new Blob([text], { type: 'text/plain' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  URL.revokeObjectURL(url);
}
