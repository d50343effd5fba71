// Bytes as people write them: `55 55 02 07`. Knows nothing of packets.

const PAIRS = Array.from({ length: 256 }, (_, byte) => byte.toString(16).toUpperCase().padStart(2, '0'));

/** Upper case, one space between bytes; the empty string for no bytes. */
export function toHex(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => PAIRS[byte]).join(' ');
}

/** Any case, white space optional between bytes. Throws SyntaxError on anything that is not whole bytes. */
export function fromHex(text: string): Uint8Array {
  if (!/^\s*([0-9a-f]{2}\s*)*$/i.test(text)) throw new SyntaxError(`not hexadecimal bytes: ${text}`);
  const digits = text.replace(/\s+/g, '');
  const bytes = new Uint8Array(digits.length / 2);
  for (let i = 0; i < bytes.length; i++) bytes[i] = parseInt(digits.slice(2 * i, 2 * i + 2), 16);
  return bytes;
}
