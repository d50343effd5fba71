import { expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createAudioUnderTest } from './audioUnderTest.ts';
import { type Course, createSoundPlayer, type Playable } from './soundPlayer.ts';

const FRAME_MS = 16;

function playing({ lengthMs = 60_000, startMs = 0 } = {}) {
  const clock = createVirtualClock();
  const audio = createAudioUnderTest(clock);
  let sound: Playable | null = { buffer: { duration: lengthMs / 1000 } as AudioBuffer, startMs };
  const player = createSoundPlayer({
    clock,
    createContext: () => audio.context,
    playable: () => sound,
  });
  player.wake();
  return {
    ...{ clock, audio, player },
    /** Follows it for so long, frame by frame. */
    async follow(course: Course | null, forMs: number): Promise<void> {
      for (let passedMs = 0; passedMs < forMs; passedMs += FRAME_MS) {
        player.follow(course);
        await clock.advance(FRAME_MS);
      }
    },
    moveSound: (by: number) => {
      if (sound !== null) sound = { ...sound, startMs: sound.startMs + by };
    },
    remove: () => (sound = null),
  };
}

const STEADY: Course = { atMs: 0, sinceMs: 500, rate: 1, untilMs: 10_000, thenMs: null };

test('what is yet to begin is scheduled ahead, and heard from its first moment at the right time', async () => {
  const { audio, follow } = playing();
  await follow(STEADY, 900);
  expect(audio.given).toHaveLength(1);
  expect(audio.heardAt(499)).toEqual([]);
  expect(audio.heardAt(501)[0]).toBeCloseTo(1);
  expect(audio.heardAt(899)[0]).toBeCloseTo(399);
});

test('what is under way is joined where it is, whatever the loudspeakers are late by', async () => {
  const { audio, follow } = playing({ startMs: -2000 });
  await follow({ ...STEADY, sinceMs: -1000 }, 400);
  expect(audio.given).toHaveLength(1);
  expect(audio.heardAt(300)[0]).toBeCloseTo(3300);
});

test('a sound that begins later than the motion waits for its time, at any pace', async () => {
  const { audio, follow } = playing({ startMs: 1000 });
  await follow({ ...STEADY, rate: 0.5 }, 3000);
  expect(audio.heardAt(2499)).toEqual([]);
  expect(audio.heardAt(2700)[0]).toBeCloseTo(100);
  expect(audio.given[0]?.rate).toBe(0.5);
});

test('it ends with the motion, and with itself', async () => {
  const long = playing();
  await long.follow({ ...STEADY, untilMs: 1000 }, 1000);
  expect(long.audio.heardAt(1499)).toHaveLength(1);
  expect(long.audio.heardAt(1501)).toEqual([]);
  const short = playing({ lengthMs: 300 });
  await short.follow(STEADY, 1400);
  expect(short.audio.given).toHaveLength(1);
});

test('little is left as it is, one late report is not believed, two are, and much at once; never is it heard twice', async () => {
  const { audio, follow } = playing();
  /** In a steady motion; `lateMs`: how late the report of it comes. */
  const report = (atMs: number, lateMs: number): Promise<void> =>
    follow({ ...STEADY, atMs, sinceMs: atMs + lateMs }, 320);
  for (const [index, lateMs] of [0, 5, 40, 4, 3, 30].entries()) await report(320 * index, lateMs);
  expect(audio.given).toHaveLength(1);
  await report(1920, 30);
  expect(audio.given).toHaveLength(2);
  await report(2240, 130);
  expect(audio.given).toHaveLength(3);
  const heard = audio.heardAt(2500);
  expect(heard).toHaveLength(1);
  expect(heard[0]).toBeCloseTo(2370);
  for (let atMs = 150; atMs < 2500; atMs += 7) expect(audio.heardAt(atMs).length).toBeLessThan(2);
});

test('a loop goes on without a gap, though its next pass is reported late', async () => {
  const { audio, follow } = playing();
  const first = { ...STEADY, sinceMs: 0, untilMs: 2000, thenMs: 500 };
  await follow(first, 2016);
  await follow({ ...first, atMs: 500, sinceMs: 2003 }, 1000);
  expect(audio.given).toHaveLength(2);
  for (let atMs = 200; atMs < 2900; atMs += 5) expect(audio.heardAt(atMs)).toHaveLength(1);
  expect(audio.heardAt(1999)[0]).toBeCloseTo(1999);
  expect(audio.heardAt(2001)[0]).toBeCloseTo(501);
});

test('a pause, a stop and a sound that is removed silence it at once; one that is moved is heard from its new place', async () => {
  const { audio, clock, follow, moveSound, player, remove } = playing();
  await follow(STEADY, 1000);
  moveSound(200);
  await follow(STEADY, 400);
  expect(audio.heardAt(1400)[0]).toBeCloseTo(700);
  player.follow(null);
  expect(audio.heardAt(clock.now() + 130)).toEqual([]);
  await follow(STEADY, 400);
  expect(audio.heardAt(clock.now())).toHaveLength(1);
  remove();
  player.follow(STEADY);
  expect(audio.heardAt(clock.now() + 130)).toEqual([]);
});

test('muted here it goes on unheard', async () => {
  const { audio, follow, player } = playing();
  await follow(STEADY, 600);
  player.setMuted(true);
  expect(audio.volume()).toBe(0);
  player.setMuted(false);
  expect(audio.volume()).toBe(1);
  expect(audio.given).toHaveLength(1);
});
