// What people write who read the protocol document and nothing else: the codec to compare with. It packs whatever it is
// told, and it believes every header; it knows no limits, no shapes and no noise.

/** Two header bytes, the length, the command: from an array literal, as in most published clients. */
export function naiveEncode(command: number, params: readonly number[]): Uint8Array {
  return Uint8Array.from([0x55, 0x55, params.length + 2, command, ...params]);
}

/** Appends each chunk to what is there, looks for a header, waits for as many bytes as its length byte says. */
export function createNaiveDecoder(emit: (packet: Uint8Array) => void): (chunk: Uint8Array) => void {
  let buffer = new Uint8Array(0);
  return (chunk) => {
    buffer = joined(buffer, chunk);
    for (;;) {
      const from = findHeader(buffer);
      const length = from < 0 ? undefined : buffer[from + 2];
      if (length === undefined || buffer.length < from + length + 2) return;
      emit(buffer.slice(from, from + length + 2));
      buffer = buffer.slice(from + length + 2);
    }
  };
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array<ArrayBuffer> {
  const both = new Uint8Array(first.length + second.length);
  both.set(first);
  both.set(second, first.length);
  return both;
}

function findHeader(bytes: Uint8Array): number {
  for (let from = bytes.indexOf(0x55); from >= 0; from = bytes.indexOf(0x55, from + 1)) {
    if (bytes[from + 1] === 0x55) return from;
  }
  return -1;
}
