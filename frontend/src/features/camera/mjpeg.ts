// Motion JPEG: finds the pictures in a multipart body as it arrives. Bytes in, pictures out; knows no camera, no network and no canvas.

/** A picture of a usual camera has a tenth of it. */
const LARGEST_PART_BYTES = 8 * 1024 * 1024;
const HEAD_END = bytesOf('\r\n\r\n');
const LONGEST_HEAD_BYTES = 4096;

/** Throws what is wrong with the stream. */
export interface PartReader {
  /** The pictures that end in these bytes, in order. */
  push(chunk: Uint8Array): readonly Uint8Array<ArrayBuffer>[];
}

/** `multipart/x-mixed-replace; boundary=NAME`; null where it is something else. Some cameras write the dashes into the name. */
export function boundaryIn(contentType: string): string | null {
  const [, quoted, plain] = /^multipart\/[^;]+;.*\bboundary=(?:"([^"]+)"|([^;\s]+))/i.exec(contentType) ?? [];
  const name = (quoted ?? plain ?? '').replace(/^-+/, '');
  return name === '' ? null : name;
}

/** A part ends after its `Content-Length`, or before the next boundary where it has none. */
export function createPartReader(boundary: string): PartReader {
  const mark = bytesOf(`--${boundary}`);
  let waiting = new Uint8Array();

  function take(): Uint8Array<ArrayBuffer> | null {
    const from = indexOf(waiting, mark);
    if (from < 0) {
      if (waiting.length > LARGEST_PART_BYTES) throw new Error('no boundary');
      return null;
    }
    const headEnd = indexOf(waiting, HEAD_END, from);
    if (headEnd < 0) {
      if (waiting.length - from > LONGEST_HEAD_BYTES) throw new Error('a part without an end of its head');
      return null;
    }
    const start = headEnd + HEAD_END.length;
    const [, length] = /content-length:\s*(\d+)/i.exec(textOf(waiting.subarray(from, headEnd))) ?? [];
    const end = length === undefined ? endBefore(indexOf(waiting, mark, start)) : start + Number(length);
    if ((end < 0 ? waiting.length : end) - start > LARGEST_PART_BYTES)
      throw new Error('a part that is too large');
    if (end < start || end > waiting.length) return null;
    const part = waiting.slice(start, end);
    waiting = waiting.subarray(end);
    return part;
  }

  /** The line break in front of a boundary belongs to it. */
  function endBefore(next: number): number {
    if (next < 0) return -1;
    return next - (waiting[next - 2] === 13 && waiting[next - 1] === 10 ? 2 : 0);
  }

  return {
    push(chunk) {
      const joined = new Uint8Array(waiting.length + chunk.length);
      joined.set(waiting);
      joined.set(chunk, waiting.length);
      waiting = joined;
      const parts: Uint8Array<ArrayBuffer>[] = [];
      for (let part = take(); part !== null; part = take()) if (part.length > 0) parts.push(part);
      return parts;
    },
  };
}

function bytesOf(text: string): Uint8Array {
  return new TextEncoder().encode(text);
}

const textOf = (bytes: Uint8Array): string => new TextDecoder('latin1').decode(bytes);

function indexOf(bytes: Uint8Array, wanted: Uint8Array, from = 0): number {
  const [first = 0] = wanted;
  for (let at = bytes.indexOf(first, from); at >= 0; at = bytes.indexOf(first, at + 1))
    if (wanted.every((byte, index) => bytes[at + index] === byte)) return at;
  return -1;
}
