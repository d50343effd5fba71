// Files between the page and the system: what it asks for, and what it saves. Nothing of either reaches a disk.

export interface Given {
  readonly name: string;
  readonly mimeType?: string;
  readonly buffer: Uint8Array;
}

interface FileChooser {
  setFiles(files: Given | readonly Given[]): Promise<void>;
}

interface Download {
  suggestedFilename(): string;
  text(): Promise<string>;
  content(): Promise<Uint8Array>;
}

interface Events {
  filechooser: FileChooser;
  download: Download;
}

/** Until `end`. Tests ask for the next of a kind before they cause it. */
export function watchFiles() {
  const waiting: { [K in keyof Events]: ((happened: Events[K]) => void)[] } = {
    filechooser: [],
    download: [],
  };
  const listening = new AbortController();

  function chooserOf(input: HTMLInputElement): FileChooser {
    return {
      setFiles(files) {
        const chosen = new DataTransfer();
        for (const { name, mimeType = '', buffer } of [files].flat() as readonly Given[])
          chosen.items.add(new File([buffer.slice()], name, { type: mimeType }));
        input.files = chosen.files;
        input.dispatchEvent(new Event('input', { bubbles: true }));
        input.dispatchEvent(new Event('change', { bubbles: true }));
        return Promise.resolve();
      },
    };
  }

  function hear(event: MouseEvent): void {
    const { target } = event;
    if (target instanceof HTMLInputElement && target.type === 'file') {
      event.preventDefault();
      waiting.filechooser.shift()?.(chooserOf(target));
    } else if (target instanceof HTMLAnchorElement && target.download !== '') {
      event.preventDefault();
      const { download: name, href } = target;
      // At once: the page takes the address back.
      const content = fetch(href).then(async (answer) => new Uint8Array(await answer.arrayBuffer()));
      const text = async (): Promise<string> => new TextDecoder().decode(await content);
      waiting.download.shift()?.({ suggestedFilename: () => name, content: () => content, text });
    }
  }

  window.addEventListener('click', hear, { capture: true, signal: listening.signal });
  const click = HTMLElement.prototype.click;
  // One that stands nowhere is heard by no one.
  HTMLElement.prototype.click = function (this: HTMLElement) {
    if (this.isConnected) click.call(this);
    else {
      this.addEventListener('click', hear, { once: true });
      click.call(this);
    }
  };

  return {
    next: <K extends keyof Events>(kind: K): Promise<Events[K]> =>
      new Promise((resolve) => waiting[kind].push(resolve)),
    end() {
      listening.abort();
      HTMLElement.prototype.click = click;
    },
  };
}
