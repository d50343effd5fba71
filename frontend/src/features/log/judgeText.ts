// What a text that is being typed as a packet means: the packet, if it may go, and the words for it. Pure.

import type { Family } from '#shared/codec/families.ts';
import { fromHex } from '#shared/codec/packet.ts';
import { judgeRaw } from '#shared/codec/rawPacket.ts';
import { isHarmless } from '#shared/codec/commands.ts';
import type { SessionState } from '#shared/robot/state.ts';
import { rawText } from './packetText.ts';
import { boardName } from '../../i18n/sentences/boards.ts';
import { words } from '../../i18n/whole.ts';

export interface Judged {
  /** Null where it may not go. */
  readonly packet: Uint8Array | null;
  readonly explanation: string;
  readonly isRefused: boolean;
  /** It goes also while motion waits for Resume. */
  readonly isHarmless: boolean;
}

export function judgeText(text: string, family: Family): Judged {
  const bytes = bytesOf(text);
  const nothing = { packet: null, isHarmless: false };
  if (bytes === null) return { ...nothing, explanation: words.raw.notHex, isRefused: true };
  if (bytes.length === 0) return { ...nothing, explanation: words.raw.hint, isRefused: false };
  const verdict = judgeRaw(bytes, family);
  const explanation = rawText(verdict, bytes, boardName(family));
  if (verdict.kind === 'refused') return { ...nothing, explanation, isRefused: true };
  if (verdict.kind === 'incomplete') return { ...nothing, explanation, isRefused: false };
  const harmless = verdict.kind === 'command' && isHarmless(verdict.command);
  return { packet: bytes, explanation, isRefused: false, isHarmless: harmless };
}

/** What keeps it from going now, as a sentence; null where nothing does. */
export function obstacleFor(judged: Judged, { link, latch, activity }: SessionState): string | null {
  if (judged.packet === null) return null;
  if (link.status !== 'ready') return words.servos.blocked.closed;
  if (activity.kind === 'downloading' || activity.kind === 'erasing') return words.servos.blocked.busy;
  return latch !== null && !judged.isHarmless ? words.raw.waits : null;
}

/** A digit whose other half is still to be typed is no mistake yet. Null where it is no hex. */
function bytesOf(text: string): Uint8Array | null {
  if (!/^[0-9a-f\s]*$/iu.test(text)) return null;
  const digits = text.replace(/\s+/gu, '');
  return fromHex(digits.slice(0, digits.length - (digits.length % 2)));
}
