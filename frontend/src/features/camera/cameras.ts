// The cameras at the gateway: their list, and the pictures of one, which come as motion JPEG in a multipart body; and how many pictures come.
// Knows no canvas and no robot.

import * as v from 'valibot';
import { words } from '../../i18n/whole.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import { isWithoutGateway, request } from '../../robot/request.ts';

const LIST_WITHIN_MS = 5000;
const listSchema = v.array(v.object({ id: v.number(), name: v.string() }));
export type Cameras = v.InferOutput<typeof listSchema>;

/** None where no gateway answers; rejects with the reason where one refuses. */
export async function listCameras(): Promise<Cameras> {
  if (isWithoutGateway()) return [];
  try {
    return v.parse(listSchema, await request('get', '/api/cameras', { withinMs: LIST_WITHIN_MS }));
  } catch (error) {
    if (error instanceof GatewayProblem && error.code === null) return [];
    throw error;
  }
}

/** Until it ends; rejects with what ended it. A picture that comes while another one is shown replaces the one that waits. */
export async function watch(
  id: number,
  signal: AbortSignal,
  show: (picture: Blob) => Promise<void>,
): Promise<void> {
  const answer = await fetch(`api/cameras/${id}/stream`, { signal });
  const boundary = boundaryIn(answer.headers.get('content-type') ?? '');
  if (!answer.ok || answer.body === null || boundary === null) throw await refusalIn(answer);
  const parts = createPartReader(boundary);
  let newest: Blob | null = null;
  let isShowing = false;
  const showNewest = async (): Promise<void> => {
    if (isShowing) return;
    isShowing = true;
    for (let picture = newest; picture !== null; picture = newest) {
      newest = null;
      await show(picture);
    }
    isShowing = false;
  };
  const reader = answer.body.getReader();
  for (let chunk = await reader.read(); !chunk.done; chunk = await reader.read()) {
    const last = parts.push(chunk.value).at(-1);
    if (last === undefined) continue;
    newest = new Blob([last], { type: 'image/jpeg' });
    void showNewest();
  }
  throw new GatewayProblem(null, words.camera.ended);
}

async function refusalIn(answer: Response): Promise<GatewayProblem> {
  const said: unknown = await answer.json().catch(() => null);
  const detail = v.safeParse(v.object({ code: v.string(), detail: v.string() }), said);
  return new GatewayProblem(
    detail.success ? detail.output.code : null,
    detail.success ? detail.output.detail : words.camera.unreachable,
  );
}

export function reasonIn(error: unknown): string {
  if (error instanceof GatewayProblem) return error.message;
  // As `fetch` and its readers report a network that fails.
  return error instanceof TypeError ? words.camera.unreachable : words.camera.unreadable;
}

/** How many pictures have come, in ms of one clock. */
export interface Arrivals {
  note(nowMs: number): void;
  /** Pictures a second, null until it can be known; and the age of the newest one. */
  figures(nowMs: number): { readonly rate: number | null; readonly ageMs: number };
}

const RATE_OVER_MS = 2000;

export function createArrivals(): Arrivals {
  let firstMs: number | null = null;
  const times: number[] = [];
  return {
    note(nowMs) {
      firstMs ??= nowMs;
      times.push(nowMs);
      while ((times[0] ?? nowMs) < nowMs - RATE_OVER_MS) times.shift();
    },
    figures(nowMs) {
      const recent = times.filter((time) => time > nowMs - RATE_OVER_MS).length;
      const isKnown = firstMs !== null && nowMs - firstMs >= RATE_OVER_MS;
      return {
        rate: isKnown ? Math.round((recent * 1000) / RATE_OVER_MS) : null,
        ageMs: Math.round(Math.max(0, nowMs - (times.at(-1) ?? nowMs))),
      };
    },
  };
}

// Motion JPEG: the pictures in a body as it arrives.

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
