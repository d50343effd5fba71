// Bytes as text, in the encodings such files come in. What decodes them is handed in: it belongs to the browser.

import { Unreadable, type Remark } from './reading.ts';

/** `gb2312` is left out: what decodes `gbk` reads it too. */
export const ENCODINGS = ['utf-8', 'utf-16le', 'gbk'] as const;
export type Encoding = (typeof ENCODINGS)[number];

/** Without its byte order mark; null where the bytes are none of this encoding. */
export type Decode = (bytes: Uint8Array, encoding: Encoding) => string | null;

export interface Text {
  readonly text: string;
  readonly remarks: readonly Remark[];
}

export function textOf(bytes: Uint8Array, decode: Decode): Text {
  const isUtf16 = bytes[0] === 0xff && bytes[1] === 0xfe;
  for (const encoding of isUtf16 ? (['utf-16le'] as const) : (['utf-8', 'gbk'] as const)) {
    const text = decode(bytes, encoding);
    if (text !== null && !text.includes('\0')) return { text, remarks: remarksOn(encoding) };
  }
  throw new Unreadable('unknownFormat');
}

/** Which of the Chinese encodings it was is a guess, and names may come out wrong. */
const remarksOn = (encoding: Encoding): readonly Remark[] =>
  encoding === 'gbk' ? [{ code: 'otherEncoding', place: null, found: 'GBK' }] : [];
