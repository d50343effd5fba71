// The one slot between the interrupt that receives and the loop that serves (S9, S10). What an earlier packet left behind
// the present one stays there, and the handlers read it (S13-S15). Knows no command.

export interface Mailbox {
  /** Read in place by the handlers, even while the next packet overwrites it. */
  readonly slot: Uint8Array;
  readonly waiting: () => boolean;
  /** Drops the packet without a word while one waits (S9). */
  readonly put: (packet: Uint8Array) => void;
  /** Clears the flag before the handler runs (S10); false if nothing waits. */
  readonly take: () => boolean;
}

const SLOT_BYTES = 260;

export function createMailbox(): Mailbox {
  const slot = new Uint8Array(SLOT_BYTES);
  let ready = false;
  return {
    slot,
    waiting: () => ready,
    put(packet) {
      if (ready) return;
      slot.set(packet);
      ready = true;
    },
    take() {
      const taken = ready;
      ready = false;
      return taken;
    },
  };
}
