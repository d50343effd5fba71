// Asks a session for what the host of a recording wanted. Knows the operations of a session; not where the wishes come from.

import type { Session } from '../session/session.ts';
import type { Intent } from './intents.ts';

type Perform<K extends Intent['kind']> = (intent: Extract<Intent, { kind: K }>) => Promise<unknown>;

/** `failed` hears of each wish that was refused or came to nothing. */
export function createHost(
  session: Session,
  failed: (what: Intent['kind'], error: unknown) => void,
): (intent: Intent) => void {
  const perform: { readonly [K in Intent['kind']]: Perform<K> } = {
    async move({ targets, durationMs }) {
      session.move(targets, durationMs);
      await Promise.resolve();
    },
    run: ({ slot, times }) => session.run(slot, times),
    stopGroup: () => session.stopGroup(),
    halt: () => session.halt(),
    resume: () => session.resume(),
    close: () => session.close(),
    erase: () => session.erase(),
    readBattery: () => session.readBattery(),
    raw: ({ bytes }) => session.sendRaw(bytes),
    download: ({ slot, frames }) => session.download([{ slot, frames }]),
    cancelDownload: () => session.cancelDownload(),
  };

  return (intent) => {
    const work = perform[intent.kind] as Perform<typeof intent.kind>;
    work(intent as never).catch((error: unknown) => failed(intent.kind, error));
  };
}
