// What the gateway plays for this page by its own clock: hands the frames over, ends it, hears how it ended. Knows the words for
// it; what may be played the gateway decides.

import type { LinkError } from '#shared/robot/linkError.ts';
import type { Frame } from '#shared/codec/commands.ts';
import type { Played, PlayOptions } from '#shared/robot/robot.ts';
import { MESSAGE_BYTES } from '#shared/robot/timings.ts';
import { askGateway, frameBody, refusal } from './gatewayValues.ts';
import type { ClientMessage, PlayedMessage, PlayMessage } from '#shared/client/messages.generated.ts';

export interface GatewayPlayer {
  /** Resolves when it has ended, however. */
  play(frames: readonly Frame[], options: PlayOptions): Promise<Played>;
  /** What was begun from here ends with its frame in progress. */
  stop(): void;
  refused(id: number, error: LinkError): void;
  ended(message: PlayedMessage): void;
  /** Its end will not be heard. */
  gone(error: LinkError): void;
}

interface Waiter {
  readonly id: number;
  readonly resolve: (played: Played) => void;
  readonly reject: (error: unknown) => void;
  isHandedOver: boolean;
}

const TAKEN_WITHIN_MS = 8_000;
/** Of the half second that the gateway takes words for new, a large group needs most for its way. */
const NEW_MS = 100;

const NOTHING_PLAYED: Played = { lateFrames: 0, latestMs: 0, skippedFrames: 0, isWhole: false };

/** The end is shown elsewhere already. */
const SAID_ELSEWHERE = ['cancelled', 'latched', 'notDriving'];

/** `begin` gives the nonce of this page's lease. */
export function createGatewayPlayer(
  post: (message: ClientMessage) => void,
  begin: (withinMs: number) => Promise<string>,
  newId: () => number,
): GatewayPlayer {
  let waiter: Waiter | null = null;

  async function handOver(mine: Waiter, wish: Omit<PlayMessage, 'type' | 'nonce' | 'id'>): Promise<void> {
    const nonce = await begin(NEW_MS);
    if (waiter !== mine) return;
    const message: PlayMessage = { type: 'play', id: mine.id, nonce, ...wish };
    const { type: _, ...body } = message;
    if (JSON.stringify(message).length <= MESSAGE_BYTES) post(message);
    else await askGateway('post', '/api/play', { body, withinMs: TAKEN_WITHIN_MS });
    mine.isHandedOver = true;
    // Its end was wanted while it was on its way.
    if (waiter !== mine) post({ type: 'stopPlaying' });
  }

  function settle(id: number | undefined, how: (waiter: Waiter) => void): void {
    if (waiter === null || waiter.id !== id) return;
    const settled = waiter;
    waiter = null;
    how(settled);
  }

  return {
    play(frames, { times = 1, loopFrom = 0, anyway = false }) {
      return new Promise((resolve, reject) => {
        const mine = (waiter = { id: newId(), resolve, reject, isHandedOver: false });
        const wish = { frames: frames.map(frameBody), times, loopFrom, anyway };
        handOver(mine, wish).catch((error: unknown) => settle(mine.id, (one) => one.reject(error)));
      });
    },
    stop() {
      if (waiter === null) return;
      if (waiter.isHandedOver) post({ type: 'stopPlaying' });
      else settle(waiter.id, ({ resolve }) => resolve(NOTHING_PLAYED));
    },
    refused: (id, error) => settle(id, ({ reject }) => reject(error)),
    ended({ id, play: { status, code, detail, lateFrames, latestMs, skippedFrames } }) {
      settle(id, ({ resolve, reject }) => {
        if (code !== null && !SAID_ELSEWHERE.includes(code)) reject(refusal(code, detail ?? ''));
        else resolve({ lateFrames, latestMs, skippedFrames, isWhole: status === 'done' });
      });
    },
    gone: (error) => settle(waiter?.id, ({ reject }) => reject(error)),
  };
}
