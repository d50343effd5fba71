// What must outlive a session: slots whose download was begun and not finished (S35). Knows no storage; whoever builds the
// session brings one that belongs to its board.

export interface SlotMemory {
  /** Asked when the link is ready, because only then it is certain which board is there. */
  read(): readonly number[];
  /** All broken slots. Called before the first byte of a download leaves. Never throws. */
  write(brokenSlots: readonly number[]): void;
}
