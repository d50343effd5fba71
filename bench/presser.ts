// A person on the gateway's WebSocket who presses STOP, and may drive, as a page does and without one. Knows the messages;
// measures nothing but when the press was.

import { once } from 'node:events';
import { sleep } from '#shared/clock.ts';
import { encodeCommand } from '#shared/codec/encode.ts';
import type { Command } from '#shared/codec/commands.ts';
import { family } from '#shared/codec/families.ts';
import type { ClientMessage, GatewayMessage } from '#shared/client/messages.generated.ts';
import { realClock } from './realClock.ts';

const PATIENCE_MS = 15_000;

export type Presser = Awaited<ReturnType<typeof comesTo>>;

/** Lends `work` a client of the gateway at `url`. */
export async function withPresser<Result>(
  url: string,
  work: (presser: Presser) => Promise<Result>,
): Promise<Result> {
  const socket = new WebSocket(`${url.replace('http', 'ws')}/ws`);
  try {
    return await work(await comesTo(socket));
  } finally {
    socket.close();
  }
}

async function comesTo(socket: WebSocket) {
  const say = (message: ClientMessage): void => socket.send(JSON.stringify(message));
  let nonce: string | null = null;
  let lastId = 0;
  let noticed = (_message: GatewayMessage): void => undefined;
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(String(data)) as GatewayMessage;
    if (message.type === 'tick') say({ type: 'heartbeat', nonce: (nonce = message.nonce) });
    noticed(message);
  };

  /** The next message that `isIt`. */
  function hear(isIt: (message: GatewayMessage) => boolean, what: string): Promise<void> {
    return new Promise((resolve, reject) => {
      const late = setTimeout(() => reject(new Error(`the gateway did not say ${what}`)), PATIENCE_MS);
      noticed = (message) => {
        if (!isIt(message)) return;
        clearTimeout(late);
        resolve();
      };
    });
  }

  await once(socket, 'open');
  return {
    get nonce() {
      return nonce;
    },
    async drive(): Promise<void> {
      const known = hear(
        (message) => message.type === 'state' && message.link.status === 'ready',
        'that it knows the board',
      );
      say({ type: 'board', id: (lastId += 1), board: 'doc' });
      await known;
      const ticked = hear(({ type }) => type === 'tick', 'tick');
      say({ type: 'lease', action: 'request' });
      await ticked;
    },
    async send(command: Command): Promise<void> {
      const id = (lastId += 1);
      const sent = hear((message) => message.type === 'done' && message.id === id, `sent ${id}`);
      const packet = Buffer.from(encodeCommand(command, family('doc'))).toString('hex');
      say({ type: 'packet', id, bytes: packet, nonce });
      await sent;
    },
    /** When, in milliseconds since the epoch; the sequence goes on behind it. */
    press(): number {
      const atMs = Date.now();
      say({ type: 'stop', reason: 'person' });
      return atMs;
    },
    /** Presses, and resumes when the whole sequence has left. */
    async pressAndResume(): Promise<number> {
      const halted = hear(({ type }) => type === 'halted', 'halted');
      const atMs = this.press();
      await halted;
      await this.resume();
      return atMs;
    },
    async resume(): Promise<void> {
      const released = hear(
        (message) => message.type === 'state' && !message.latch,
        'that the latch is open',
      );
      say({ type: 'resume' });
      await released;
    },
    /** At any moment of what goes on, within so many milliseconds. */
    waitWithin: (shortestMs: number, longestMs: number): Promise<void> =>
      sleep(realClock, shortestMs + Math.random() * (longestMs - shortestMs)),
  };
}
