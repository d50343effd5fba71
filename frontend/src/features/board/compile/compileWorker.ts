// The worker beside the page: each message is a group as text, and is answered with its frames as numbers.

import { groupFromText } from '#shared/group/group.ts';
import { numbersOf } from '#shared/group/fingerprint.ts';
import { compileSource, type Source, type CompileResult } from './compileSource.ts';

export interface Order {
  readonly groupText: string;
  readonly options: Omit<Source, 'group'>;
}

export interface Answer extends Omit<CompileResult, 'frames'> {
  readonly numbers: Int32Array;
}

addEventListener('message', ({ data, ports: [port] }: MessageEvent<Order>) => {
  const { groupText, options } = data;
  const read = groupFromText(groupText);
  if ('problem' in read) throw new TypeError(read.problem.code);
  const { frames, ...rest } = compileSource({ group: read.value, ...options });
  const numbers = Int32Array.from(numbersOf(frames));
  port?.postMessage({ ...rest, numbers } satisfies Answer, [numbers.buffer]);
});
