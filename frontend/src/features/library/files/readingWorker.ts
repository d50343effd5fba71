// The worker that reads files: each message is a file and is answered with what it holds.

import { readFile } from './readFile.ts';

addEventListener('message', ({ data: file, ports: [port] }: MessageEvent<File>) => {
  void readFile(file).then((reading) => port?.postMessage(reading));
});
