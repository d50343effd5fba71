// Asks a board who it is, by questions that move nothing and store nothing on any board, in the order of boards.md 2.5. Knows
// how to ask and how long to wait; what the answers mean is identity.ts. On a LeArm any question ends a running group (L8).

import { sleep, type Clock } from '../clock.ts';
import type { Command } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import { UNKNOWN_BOARD, type Question } from '../codec/families.ts';
import { toHex } from '../codec/packet.ts';
import type { ReportKind } from '../codec/reports.ts';
import { isNoAnswer, type Exchange } from './replies.ts';
import type { Evidence } from './identity.ts';
import { LinkError } from './linkError.ts';
import { BOOT_MS, IDENTIFY_ATTEMPTS, IDENTIFY_LISTEN_MS, IDENTIFY_TIMEOUT_MS } from './timings.ts';

export interface IdentifyOptions {
  readonly clock: Clock;
  readonly exchange: Exchange;
  /** Bytes heard so far that were no packets. */
  noiseBytes(): number;
  /** Packets heard so far that were our own question. */
  echoes(): number;
}

export const QUESTIONS: Readonly<
  Record<Question, { readonly command: Command; readonly answer: ReportKind }>
> = {
  readBattery: { command: { kind: 'readBattery' }, answer: 'battery' },
  readVersion: { command: { kind: 'readVersion' }, answer: 'version' },
  // One servo's is enough: bus boards answer, the others do not know the question.
  readPositions: { command: { kind: 'readPositions', servos: [1] }, answer: 'positions' },
};

/** Rejects when the link goes meanwhile. */
export async function identify({
  clock,
  exchange,
  noiseBytes,
  echoes,
}: IdentifyOptions): Promise<readonly Evidence[]> {
  const noiseBefore = noiseBytes();
  const echoesBefore = echoes();

  async function attempt({ command, answer }: (typeof QUESTIONS)[Question], question: Question) {
    try {
      const report = await exchange.ask(command, answer, IDENTIFY_TIMEOUT_MS);
      return { kind: 'answered', question, report } as const;
    } catch (error) {
      // A stop empties the queue; it does not answer the question.
      if (isNoAnswer(error) || isLatched(error)) return null;
      throw error;
    }
  }

  async function ask(question: Question): Promise<Evidence> {
    for (let left = IDENTIFY_ATTEMPTS; left > 0; left -= 1) {
      const answered = await attempt(QUESTIONS[question], question);
      if (answered !== null) return answered;
    }
    return { kind: 'silent', question };
  }

  async function askAll(): Promise<readonly Evidence[]> {
    const battery = await ask('readBattery');
    return [battery, await ask(battery.kind === 'answered' ? 'readPositions' : 'readVersion')];
  }

  await sleep(clock, IDENTIFY_LISTEN_MS);
  let answers = await askAll();
  // Text lines come from a LeArm that has just restarted and is deaf for a while (L1).
  const isStarting = noiseBytes() > noiseBefore && echoes() === echoesBefore;
  if (isStarting && answers.every(({ kind }) => kind === 'silent')) {
    await sleep(clock, BOOT_MS);
    answers = await askAll();
  }
  const byteCount = noiseBytes() - noiseBefore;
  return [
    ...answers,
    ...(echoes() > echoesBefore ? [{ kind: 'echoed' } as const] : []),
    ...(byteCount > 0 ? [{ kind: 'noise', byteCount } as const] : []),
  ];
}

const QUESTION_TEXTS = Object.values(QUESTIONS).map(({ command }) =>
  toHex(encodeCommand(command, UNKNOWN_BOARD)),
);

/** What came in holds one of our own questions. */
export function isEcho(bytes: Uint8Array): boolean {
  const text = toHex(bytes);
  return QUESTION_TEXTS.some((question) => text.includes(question));
}

function isLatched(error: unknown): boolean {
  return error instanceof LinkError && error.code === 'latched';
}
