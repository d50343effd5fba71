// F6 of safety.md section 5: the chip takes 0 to 30 s for a sector, or never answers. Every wait has a named end.

import { expect, test } from 'vitest';
import { createFlashChip, type FlashChip } from '../../simulator/groupStore.ts';
import { createRandom } from '../../simulator/faults.ts';
import { LinkError } from '../linkError.ts';
import { createRig, type Rig } from '../rig.ts';
import { caseOf, named, seeds } from '../../testing/cases.ts';

const FILE = 'slowFlash.test.ts';
const SECTOR_MS = [0, 45, 400, 600, 900, 2_000, 10_000, 30_000, 1e9];
const FRAME = { durationMs: 100, targets: [{ servo: 1, position: 1_200 }] };
const FRAMES = [FRAME, { ...FRAME, durationMs: 200 }, { ...FRAME, durationMs: 300 }];
const SLOT = 5;
/** Erase waits 1 s; three attempts at frame 0 wait 2.5 s each. */
const ERASE_ENDS_MS = 1_100;
/** What the wire and the page after the sector leave of that second. */
const LONGEST_ERASE_MS = 990;

const codeOf = (error: unknown): unknown => (error instanceof LinkError ? error.code : error);
const slow = (sectorMs: number): Promise<Rig> => createRig({ faults: [{ name: 'slowErase', sectorMs }] });

/** The table; in later rounds anything up to 30 s, short times as often as long ones. */
function sectorMsOf(seed: number): number {
  const { at, round } = caseOf(seed, SECTOR_MS.length);
  return round === 0 ? (SECTOR_MS[at] ?? 0) : Math.round(30_000 ** createRandom(seed)());
}

async function eachPace(attempt: (sectorMs: number) => Promise<void>): Promise<void> {
  for (const seed of seeds(SECTOR_MS.length)) {
    const sectorMs = sectorMsOf(seed);
    await named(FILE, seed, `${sectorMs} ms a sector`, () => attempt(sectorMs));
  }
}

async function erase(sectorMs: number): Promise<void> {
  const { session, clock } = await slow(sectorMs);
  let outcome: unknown = 'hangs';
  session.erase().then(
    () => (outcome = 'erased'),
    (error: unknown) => (outcome = codeOf(error)),
  );
  expect(session.state.activity).toEqual({ kind: 'erasing' });
  await clock.advance(ERASE_ENDS_MS);
  expect(outcome).toBe(sectorMs < LONGEST_ERASE_MS ? 'erased' : 'noAnswer');
  expect(session.state.activity).toEqual({ kind: 'idle' });
}

async function store(sectorMs: number): Promise<void> {
  const { session, clock, channel } = await slow(sectorMs);
  let outcome: unknown = 'hangs';
  session.download([{ slot: SLOT, frames: FRAMES }]).then(
    () => (outcome = 'stored'),
    (error: unknown) => (outcome = codeOf(error)),
  );
  expect(session.state.activity).toMatchObject({ kind: 'downloading', slot: SLOT });
  await clock.advance(120_000);
  if (sectorMs <= 600) expect(outcome).toBe('stored');
  if (outcome === 'stored')
    expect(FRAMES.map((_, at) => channel.board.storedFrame(SLOT, at))).toEqual(FRAMES);
  else expect([outcome, session.state.brokenSlots]).toEqual(['noAnswer', [SLOT]]);
}

async function stopWhileStoring(sectorMs: number): Promise<void> {
  const rig = await slow(sectorMs);
  const outcome = rig.session.download([{ slot: SLOT, frames: FRAMES }]).catch((error: unknown) => error);
  await rig.clock.advance(35);
  const halted = rig.session.halt();
  await rig.clock.advance(180);
  await halted;
  expect(await outcome).toMatchObject({ code: 'latched' });
  expect(rig.ofKind('stop').length).toBeGreaterThanOrEqual(3);
  expect(rig.session.state).toMatchObject({ activity: { kind: 'idle' }, brokenSlots: [SLOT] });
}

const STORED_SLOT = 8;
const LONGEST_SECTOR_MS = 2_500;

async function chipWithGroup(): Promise<FlashChip> {
  const flash = createFlashChip();
  const { session, clock } = await createRig({ flash });
  const stored = session.download([{ slot: STORED_SLOT, frames: FRAMES }]);
  await clock.advance(3_000);
  await stored;
  return flash;
}

/** Stopped right behind its run, while the chip may still be at work on the download before. Says how often it was stopped. */
async function stopBehindRun(seed: number): Promise<number> {
  const random = createRandom(seed);
  const sectorMs = random() * LONGEST_SECTOR_MS;
  const flash = await chipWithGroup();
  const rig = await createRig({ flash, faults: [{ name: 'slowErase', sectorMs }] });
  const { session, clock, channel } = rig;
  const stored = session.download([{ slot: SLOT, frames: FRAMES }]).catch(() => undefined);
  await clock.advance(random() * 1_000);
  await Promise.all([session.cancelDownload(), stored, clock.advance(3_000)]);
  session.run(STORED_SLOT, 0).catch(() => undefined);
  await clock.advance(random() * 60);
  const words: unknown[] = [];
  session.subscribe({ state: ({ latch }) => void (latch?.stop !== words.at(-1) && words.push(latch?.stop)) });
  session.halt().catch(() => undefined);
  await clock.advance(5 * LONGEST_SECTOR_MS);
  expect(channel.board.runningSlot()).toBeNull();
  return words.filter((word) => word === 'sending').length;
}

test('an erase is shown and ends with a name however long it takes', () => eachPace(erase));
test('a download stores what was asked or ends with a name', () => eachPace(store));
test('STOP is served while the chip is at work', () => eachPace(stopWhileStoring));

test('a download after an interrupted one does not take its late answer for its own', async () => {
  const { session, clock, channel } = await slow(400);
  session.download([{ slot: SLOT, frames: FRAMES }]).catch(() => undefined);
  await clock.advance(35);
  await Promise.all([session.halt(), clock.advance(200)]);
  await session.resume();
  const again = session.download([{ slot: SLOT, frames: FRAMES }]);
  await clock.advance(30_000);
  await again;
  expect(FRAMES.map((_, at) => channel.board.storedFrame(SLOT, at))).toEqual(FRAMES);
});

test('STOP ends also a run that the board kept while its chip was at work', async () => {
  const stops: number[] = [];
  for (const seed of seeds(60))
    await named(FILE, seed, 'kept run', async () => void stops.push(await stopBehindRun(seed)));
  expect(Math.max(...stops)).toBe(2);
});
