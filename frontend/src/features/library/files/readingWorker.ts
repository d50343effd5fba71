// The worker that reads files: each message is a file, each answer its content.

import { readFile } from './means.ts';

addEventListener('message', ({ data: file, ports: [port] }: MessageEvent<File>) => {
  void readFile(file).then((reading) => port?.postMessage(reading));
});
