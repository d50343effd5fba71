// The flash chip: bytes that survive power-off, erased in sectors to FF, programmed by clearing bits (NOR). Changes are
// instant here; how long they block the board is groupStore.ts. Knows nothing of groups.

export interface FlashChip {
  /** A copy of `length` bytes. */
  read(address: number, length: number): Uint8Array;
  /** Bits can only be cleared: what was there and what comes are ANDed (S36). */
  program(address: number, bytes: Uint8Array): void;
  /** Erases the sector that holds `address`. */
  eraseSector(address: number): void;
}

export const SECTOR_BYTES = 4096;
const ERASED = 0xff;

export function createFlashChip(): FlashChip {
  /** Only what was ever programmed takes memory: the chip has 8 MiB. */
  const sectors = new Map<number, Uint8Array>();

  function sectorOf(address: number): number {
    return Math.floor(address / SECTOR_BYTES);
  }

  function byteAt(address: number): number {
    return sectors.get(sectorOf(address))?.[address % SECTOR_BYTES] ?? ERASED;
  }

  function read(address: number, length: number): Uint8Array {
    return Uint8Array.from({ length }, (_, index) => byteAt(address + index));
  }

  function programByte(address: number, byte: number): void {
    const sector = sectors.get(sectorOf(address)) ?? new Uint8Array(SECTOR_BYTES).fill(ERASED);
    sectors.set(sectorOf(address), sector);
    sector[address % SECTOR_BYTES] = byteAt(address) & byte;
  }

  function program(address: number, bytes: Uint8Array): void {
    for (const [index, byte] of bytes.entries()) programByte(address + index, byte);
  }

  return { read, program, eraseSector: (address) => void sectors.delete(sectorOf(address)) };
}
