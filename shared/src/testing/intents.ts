// What the host wanted, read from what it sent: packets that a session sends by itself are left to it (the repeats of a stop,
// the hold behind it, the frames of a download and their repeats). Pure; knows no clock and no session.

import type { Command, Frame } from '../codec/commands.ts';
import { HEADER } from '../codec/packet.ts';
import { commandIn } from '../codec/parse.ts';
import type { Entry } from '../files/recording.ts';

/** A session has an operation of its own for each. */
const ASKABLE = ['move', 'run', 'erase', 'readBattery'] as const;
type AskableCommand = Extract<Command, { kind: (typeof ASKABLE)[number] }>;

export type Intent =
  | AskableCommand
  /** Sent by hand, or a question that identifies a board. */
  | { readonly kind: 'raw'; readonly bytes: Uint8Array }
  | { readonly kind: 'stopGroup' | 'cancelDownload' | 'halt' | 'resume' | 'close' }
  /** Frames that were never sent are the last one again; the host gave up before them. */
  | { readonly kind: 'download'; readonly slot: number; readonly frames: readonly Frame[] };

type DownloadCommand = Extract<Command, { kind: 'download' }>;

/** Longer than two stops of one sequence are apart, its hold between them. */
const STOP_SEQUENCE_MS = 250;
const FRAME_HANDLED = 25;

/** One for each entry; null where no intent stands behind it. */
export function intentsOf(entries: readonly Entry[]): readonly (Intent | null)[] {
  let isLatched = false;
  let lastStopMs = -Infinity;
  let download: Download | null = null;

  function linkIntent(happening: Extract<Entry, { mark: 'link' }>['happening']): Intent | null {
    download = null;
    if (happening === 'stopped' || happening === 'latched') isLatched = true;
    if (happening === 'resumed' || happening === 'closed') isLatched = false;
    if (happening === 'stopped') return { kind: 'halt' };
    if (happening === 'resumed') return { kind: 'resume' };
    return happening === 'closed' ? { kind: 'close' } : null;
  }

  function sentIntent(atMs: number, bytes: Uint8Array, index: number): Intent | null {
    const command = commandIn(bytes);
    if (command?.kind === 'download') {
      if (download?.continuesWith(command) === true) return null;
      download = gatherDownload(entries, index, command);
      return download.intent;
    }
    if (command?.kind === 'stop') {
      const isRepeat = isLatched || atMs - lastStopMs < STOP_SEQUENCE_MS;
      lastStopMs = atMs;
      return isRepeat ? null : { kind: 'stopGroup' };
    }
    download = null;
    // Latched, a session sends nothing that moves but its own hold.
    if (command?.kind === 'move' && isLatched) return null;
    if (isAskable(command)) return command;
    // What begins otherwise is the filler after a cut packet: the session sends it by itself.
    return bytes[0] === HEADER ? { kind: 'raw', bytes } : null;
  }

  return entries.map((entry, index) => {
    if (entry.mark === 'link') return linkIntent(entry.happening);
    if (entry.mark === 'sent') return sentIntent(entry.atMs, entry.bytes, index);
    const isHandled = entry.mark === 'received' && entry.bytes[3] === FRAME_HANDLED;
    return isHandled ? (download?.handled(index) ?? null) : null;
  });
}

function isAskable(command: Command | null): command is AskableCommand {
  return command !== null && (ASKABLE as readonly string[]).includes(command.kind);
}

interface Download {
  /** Null where its beginning is not in the recording. */
  readonly intent: Intent | null;
  /** A repeat or the next frame; a group that was stored to its end is not begun again by itself. */
  continuesWith(command: DownloadCommand): boolean;
  /** The entry `index` acknowledges a frame. */
  handled(index: number): Intent | null;
}

function gatherDownload(entries: readonly Entry[], from: number, first: DownloadCommand): Download {
  const { slot, frameCount } = first;
  const { frames, lastAt, last } = sentFrames(entries, from, first);
  const [lastFrame] = frames.slice(-1);
  const isWhole = isLastFrame(last);
  let isStored = false;
  return {
    intent: lastFrame ? { kind: 'download', slot, frames: padded(frames, lastFrame, frameCount) } : null,
    continuesWith: (command) => !isStored && command.slot === slot && command.frameCount === frameCount,
    handled(index) {
      if (index < lastAt) return null;
      if (isWhole) isStored = true;
      // The board was ready for the next frame, which never came.
      return isWhole ? null : { kind: 'cancelDownload' };
    },
  };
}

interface SentFrames {
  /** By their numbers. */
  readonly frames: readonly Frame[];
  readonly last: DownloadCommand;
  readonly lastAt: number;
}

/** Until the group was stored or the host turned to something else. */
function sentFrames(entries: readonly Entry[], from: number, first: DownloadCommand): SentFrames {
  const frames: Frame[] = [];
  let [last, lastAt] = [first, from];
  for (let at = from; at < entries.length; at++) {
    const entry = entries[at];
    if (entry?.mark === 'received' && entry.bytes[3] === FRAME_HANDLED && isLastFrame(last)) break;
    if (entry?.mark === 'link') break;
    if (entry?.mark !== 'sent') continue;
    const command = commandIn(entry.bytes);
    // The repeats of a stop may fall between two frames.
    if (command?.kind === 'stop') continue;
    if (command?.kind !== 'download' || command.slot !== first.slot) break;
    [last, lastAt] = [command, at];
    if (command.frameIndex === frames.length) frames.push(command.frame);
  }
  return { frames, last, lastAt };
}

const isLastFrame = ({ frameIndex, frameCount }: DownloadCommand): boolean => frameIndex === frameCount - 1;

function padded(frames: readonly Frame[], frame: Frame, count: number): readonly Frame[] {
  return Array.from({ length: count }, (_, index) => frames[index] ?? frame);
}
