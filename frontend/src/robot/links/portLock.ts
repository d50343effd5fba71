// One tab drives: the right of this tab to a port, as a Web Lock, and the word between tabs that asks for it. The browser
// takes the lock back when a tab closes or crashes. Knows no port.

import { browserClock } from './browserClock.ts';
import { LinkError } from '#shared/robot/linkError.ts';

export interface PortLock {
  /** `asked` is called when another tab wants it. Rejects with `heldElsewhere`. */
  take(asked: () => void): Promise<void>;
  /** Harmless when it is not held. */
  release(): void;
  /** Has the tab that holds it let go, and waits for that. Rejects with `heldElsewhere` when it does not. */
  askForIt(): Promise<void>;
}

/** A page that is being reloaded or has crashed, and a port that is being closed, let go a moment after the next one asks. */
const GRANT_WITHIN_MS = 1500;
/** The other tab stops the robot and closes the port first: 2,000 and 1,250 ms at worst. */
const YIELD_WITHIN_MS = 3500;

export function createPortLock(name: string): PortLock {
  let release = (): void => undefined;

  return {
    async take(asked) {
      const free = await hold(name, GRANT_WITHIN_MS);
      const channel = new BroadcastChannel(name);
      channel.onmessage = asked;
      release = () => {
        channel.close();
        free();
      };
    },
    release: () => release(),
    async askForIt() {
      const channel = new BroadcastChannel(name);
      channel.postMessage('let go');
      const free = await hold(name, YIELD_WITHIN_MS);
      channel.close();
      free();
    },
  };
}

/** Resolves, once the lock is ours, with what frees it. */
function hold(name: string, withinMs: number): Promise<() => void> {
  const patience = new AbortController();
  const calm = browserClock.after(withinMs, () => patience.abort());
  return new Promise((resolve, reject) => {
    const untilFreed = (): Promise<void> =>
      new Promise((free) => {
        calm();
        resolve(() => free());
      });
    navigator.locks.request(name, { signal: patience.signal }, untilFreed).catch((error: unknown) => {
      reject(new LinkError('heldElsewhere', 'another tab holds the port', { cause: error }));
    });
  });
}
