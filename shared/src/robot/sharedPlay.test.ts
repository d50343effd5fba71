// A link that plays by its own clock: the session hands the frames over and shows what it is told.

import { expect, test } from 'vitest';
import type { Frame } from '../codec/commands.ts';
import { family as familyOf } from '../codec/families.ts';
import { createSimulatedTransport } from '../testing/simulatedTransport.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import type { Played } from './player.ts';
import { createSession } from './robot.ts';
import type { PlayProgress, Transport, TransportEvents } from './transport.ts';

const FRAMES: readonly Frame[] = [{ durationMs: 300, targets: [{ servo: 1, position: 1500 }] }];
const WHOLE: Played = { lateFrames: 0, latestMs: 0, skippedFrames: 0, isWhole: true };

async function sharedSession() {
  const clock = createVirtualClock();
  const line = createSimulatedTransport(clock, { onForMs: 60_000 });
  const asked: unknown[] = [];
  let tell: TransportEvents['playing'];
  let end: (played: Played) => void = () => undefined;
  const sent: Uint8Array[] = [];
  const transport: Transport = {
    ...line,
    player: {
      play(...wish) {
        asked.push(wish);
        return new Promise((resolve) => (end = resolve));
      },
      stop: () => void asked.push('stop'),
    },
    open(events) {
      tell = events.playing;
      return line.open(events);
    },
    send(packet) {
      sent.push(packet);
      return line.send(packet);
    },
  };
  const session = createSession({ transport, clock, family: familyOf('doc') });
  await session.open();
  return {
    ...{ clock, session, asked, sent },
    tell: (progress: PlayProgress | null) => tell?.(progress),
    end: (played: Played) => end(played),
  };
}

test('it sends nothing itself, shows how far it is, and its end is the link’s', async () => {
  const { clock, session, asked, sent, tell, end } = await sharedSession();
  const played = session.play(FRAMES, { times: 3, loopFrom: 0 });
  await clock.advance(2_000);
  expect(asked).toEqual([[FRAMES, 3, 0]]);
  tell({ frameIndex: 0, frameCount: 1 });
  expect(session.state.activity).toEqual({ kind: 'playing', frameIndex: 0, frameCount: 1 });
  tell(null);
  expect(session.state.activity).toEqual({ kind: 'idle' });
  end(WHOLE);
  expect(await played).toEqual(WHOLE);
  expect(sent).toEqual([]);
});

test('while it plays, whoever asked for it, nothing else begins, and sliders move', async () => {
  const { clock, session, asked, tell, sent } = await sharedSession();
  tell({ frameIndex: 4, frameCount: 9 });
  await expect(session.play(FRAMES)).rejects.toMatchObject({ code: 'busy' });
  await expect(session.run(0, 1)).rejects.toMatchObject({ code: 'busy' });
  await expect(session.erase()).rejects.toMatchObject({ code: 'busy' });
  session.move([{ servo: 1, position: 1500 }], 100);
  await clock.advance(100);
  expect([asked.length, sent.length]).toEqual([0, 1]);
});

test('a pause is the link’s to carry out', async () => {
  const { session, asked, tell } = await sharedSession();
  void session.play(FRAMES, { times: 0 });
  tell({ frameIndex: 0, frameCount: 1 });
  session.stopPlaying();
  expect(asked.slice(1)).toEqual(['stop']);
});
