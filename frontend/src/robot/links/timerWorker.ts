// The worker of browserClock.ts: each message is answered with its number, so much later.

export interface Alarm {
  readonly id: number;
  readonly delayMs: number;
}

addEventListener('message', ({ data: { id, delayMs } }: MessageEvent<Alarm>) => {
  setTimeout(() => postMessage(id), delayMs);
});
