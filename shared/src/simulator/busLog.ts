// One byte on the bus with its time, as the board's pins saw it: the oracle of tests. Knows no packet.

export interface BusLogEntry {
  /** On the clock the board was given: when the byte's last bit was there. */
  readonly atMs: number;
  /** `in`: into the board. */
  readonly direction: 'in' | 'out';
  readonly byte: number;
}
