import { expect, test } from 'vitest';
import {
  bytesOf,
  createBoardUnderTest,
  download,
  DOWNLOAD_ACK,
  hexOf,
  move,
  packet,
  READ_BATTERY,
  run,
  STOP,
} from '../../testing/board.ts';
import { parseFault } from '../faults.ts';

const QUERY_VERSION = packet(1, []);
const VERSION = '55 55 04 01 01 01';
const READ_POSITIONS = packet(13, []);
const START_POSE = [770, 1500, 644, 511, 1255, 1500];
const ALL = [1, 2, 3, 4, 5, 6];

function learm(options: { readonly onForMs?: number; readonly faults?: readonly string[] } = {}) {
  const { faults = [], ...others } = options;
  return createBoardUnderTest({
    profile: 'learm-esp32',
    baud: 0,
    faults: faults.map(parseFault),
    ...others,
  });
}

/** Stores a group that moves servo 2; each frame takes its time, then the poll's. */
async function store(under: ReturnType<typeof learm>, slot: number, ...positions: readonly number[]) {
  for (const [index, position] of positions.entries())
    await under.exchange(download(slot, positions.length, index, 200, [2, position]), 400);
  under.takeReplies();
}

test('L1: after power-up it stands in its pose at once and prints two lines before it listens', async () => {
  const { clock, exchange, pulses, takeReplies } = learm({ onForMs: 0 });
  expect(pulses(...ALL)).toEqual(START_POSE);
  await clock.advance(2600);
  expect(String.fromCharCode(...bytesOf(takeReplies()))).toBe('pwm servo\r\n');
  await exchange(QUERY_VERSION, 400);
  expect(String.fromCharCode(...bytesOf(takeReplies()))).toBe('begin\r\n');
});

test('L2: it starts in its app mode and hears nothing on USB until a person presses the key', async () => {
  const { clock, exchange, takeReplies } = learm({ onForMs: 0, faults: ['modeKey=4000'] });
  await clock.advance(3500);
  takeReplies();
  await exchange(QUERY_VERSION, 400);
  expect(takeReplies()).toBe('');
  await clock.advance(200);
  await exchange(QUERY_VERSION);
  expect(takeReplies()).toBe(VERSION);
});

test('L2: the next press of the key takes the line away again, four lead back', async () => {
  const under = learm({ faults: ['modeKey=100', 'modeKey=300', 'modeKey=301', 'modeKey=302'] });
  await under.clock.advance(150);
  await under.exchange(QUERY_VERSION, 100);
  expect(under.takeReplies()).toBe('');
  await under.clock.advance(100);
  await under.exchange(QUERY_VERSION);
  expect(under.takeReplies()).toBe(VERSION);
});

test.each(['55 55 40 03', '55 55 55 02'])(
  'L3: more than 60 data bytes after %s jam it for good',
  async (head) => {
    const { exchange, pulses, send, takeReplies } = learm();
    await exchange(move(1000, [2, 2500]), 505);
    send(`${head} ${hexOf(new Array<number>(60).fill(0))}`);
    expect(pulses(2)).toEqual([2000]);
    await exchange('00', 600);
    expect(pulses(2)).toEqual([2000]);
    await exchange(QUERY_VERSION);
    expect(takeReplies()).toBe('');
  },
);

test('L1, L3: a jammed board comes back with a reset, in its app mode', async () => {
  const { board, clock, exchange, pulses, takeReplies } = learm();
  await exchange(`55 55 FD 03 ${hexOf(new Array<number>(61).fill(0))}`);
  board.reboot();
  await clock.advance(3000);
  expect(pulses(...ALL)).toEqual(START_POSE);
  expect(String.fromCharCode(...bytesOf(takeReplies()))).toBe('pwm servo\r\nbegin\r\n');
});

test.each([
  { what: 'a number from 26 on', bytes: '55 55 04 1A' },
  { what: 'LEN 0', bytes: '55 55 00' },
  { what: 'LEN 1 with its byte', bytes: '55 55 01 0F 00' },
  { what: 'stray 55s that make a refused number', bytes: '55 55 55 55' },
])('L3: after $what the next packet is heard', async ({ bytes }) => {
  const { exchange, takeReplies } = learm();
  await exchange(`${bytes} ${QUERY_VERSION}`);
  expect(takeReplies()).toBe(VERSION);
});

test('L4: a packet may come in pieces, however far apart', async () => {
  const { exchange, takeReplies } = learm();
  for (const byte of bytesOf(QUERY_VERSION)) await exchange(hexOf([byte]), 1000);
  expect(takeReplies()).toBe(VERSION);
});

test('L5: each servo takes its own time in steps of 10 ms; the gripper opens no further than 1500', async () => {
  const { clock, exchange, pulses } = learm();
  await exchange(move(1000, [2, 2500], [1, 2500], [6, 400]), 500);
  expect(pulses(1, 2, 6)).toEqual([1135, 2000, 1000]);
  await exchange(move(20, [3, 700]), 30);
  expect(pulses(3)).toEqual([700]);
  await clock.advance(470);
  expect(pulses(1, 2, 6)).toEqual([1500, 2500, 500]);
});

test.each([
  { times: 0, loops: 1 },
  { times: 1, loops: 1 },
  { times: 2, loops: 2 },
  { times: 256, loops: 1 },
  { times: 258, loops: 2 },
])(
  'L6, L7: run $times times plays it $loops times, in polls of 110 ms and without a word',
  async ({ times, loops }) => {
    const under = learm();
    await store(under, 3, 1000, 2000);
    // 200 ms of motion are over at the second poll: 220 ms a frame.
    await under.exchange(run(3, times), loops * 2 * 220 - 10);
    expect(under.board.runningSlot()).toBe(3);
    await under.clock.advance(20);
    expect(under.board.runningSlot()).toBeNull();
    expect(under.takeReplies()).toBe('');
  },
);

test.each([
  { what: 'a position read', hex: READ_POSITIONS },
  { what: 'the battery query it does not know', hex: READ_BATTERY },
  { what: 'a bare packet with a number beyond all', hex: packet(200, []) },
])('L8, L11: $what kills the running group, and the next run skips its first frame', async ({ hex }) => {
  const under = learm();
  await store(under, 3, 1000, 2000);
  await under.exchange(run(3, 1), 50);
  expect(under.board.runningSlot()).toBe(3);
  await under.exchange(hex, 500);
  expect(under.board.runningSlot()).toBeNull();
  expect(under.pulses(2)).toEqual([1000]);
  await under.exchange(run(3, 1), 230);
  expect(under.pulses(2)).toEqual([2000]);
  expect(under.board.runningSlot()).toBeNull();
  await under.exchange(run(3, 1), 210);
  expect(under.pulses(2)).toEqual([1000]);
});

test('L9: a stop halts servos 1 to 5 within 20 ms; servo 6 goes on to its target', async () => {
  const { clock, exchange, pulses } = learm();
  await exchange(move(1000, [2, 2500], [5, 2255], [6, 2500]), 500);
  const before = pulses(2, 5);
  await exchange(STOP, 20);
  expect(pulses(2, 5)).toEqual(before);
  await clock.advance(1000);
  expect(pulses(2, 5, 6)).toEqual([...before, 2500]);
});

test('L10: a stored frame of more than six servos hangs the run until a stop', async () => {
  const under = learm();
  const entries = [1, 2, 3, 4, 5, 6, 7].map((servo) => [servo, 1500] as const);
  await under.exchange(download(3, 1, 0, 100, ...entries), 400);
  await under.exchange(run(3, 1), 60_000);
  expect(under.board.runningSlot()).toBe(3);
  await under.exchange(STOP);
  expect(under.board.runningSlot()).toBeNull();
});

test('L12: all 255 frames of a group are kept, and group 255 does not exist', async () => {
  const { board, exchange, takeReplies } = learm();
  for (let index = 0; index < 255; index += 1)
    await exchange(download(3, 255, index, 100 + index, [6, 1000 + index]), index === 0 ? 120 : 15);
  expect(takeReplies().split(DOWNLOAD_ACK)).toHaveLength(255);
  await exchange('', 100);
  expect(takeReplies()).toBe(DOWNLOAD_ACK);
  expect(board.frameCount(3)).toBe(255);
  for (const index of [0, 194, 195, 196, 254])
    expect(board.storedFrame(3, index)).toEqual({
      durationMs: 100 + index,
      targets: [{ servo: 6, position: 1000 + index }],
    });
  await exchange(download(255, 1, 0, 100, [1, 1000]), 300);
  expect(takeReplies()).toBe(DOWNLOAD_ACK);
  expect(board.frameCount(255)).toBe(0);
});

test.each([
  { what: 'version', hex: QUERY_VERSION, afterMs: 30, answer: VERSION },
  {
    what: 'offsets',
    hex: packet(2, []),
    afterMs: 20,
    answer: '55 55 0E 02 01 00 02 00 03 00 04 00 05 00 06 00',
  },
  {
    what: 'positions',
    hex: READ_POSITIONS,
    afterMs: 10,
    answer: hexOf([
      0x55,
      0x55,
      20,
      13,
      ...START_POSE.flatMap((us, index) => [index + 1, us & 0xff, us >> 8]),
    ]),
  },
])('L13: $what come after $afterMs ms', async ({ hex, afterMs, answer }) => {
  const { clock, exchange, takeReplies } = learm();
  await exchange(hex, afterMs - 1);
  expect(takeReplies()).toBe('');
  await clock.advance(2);
  expect(takeReplies()).toBe(answer);
});

test('L13: erase takes two bytes and is answered; the battery query is not', async () => {
  const under = learm();
  await store(under, 3, 1000);
  await under.exchange(packet(8, []), 100);
  expect(under.takeReplies()).toBe('55 55 02 08');
  expect(under.board.frameCount(3)).toBe(0);
  await under.exchange(READ_BATTERY, 1000);
  expect(under.takeReplies()).toBe('');
});

test('L14: an offset within 125 is taken, a larger one refused; saving them is answered', async () => {
  const { exchange, takeReplies } = learm();
  await exchange(packet(10, [1, 256 - 125]));
  await exchange(packet(10, [2, 126]));
  await exchange(packet(2, []));
  expect(takeReplies()).toBe('55 55 0E 02 01 83 02 00 03 00 04 00 05 00 06 00');
  await exchange(packet(11, []), 200);
  expect(takeReplies()).toBe('55 55 02 0B');
});

test('2.3: command 12 brings all servos to their pose in a second', async () => {
  const { exchange, pulses } = learm();
  await exchange(move(20, [2, 2500], [6, 500]), 100);
  await exchange(packet(12, []), 500);
  expect(pulses(2, 6)).toEqual([2000, 1000]);
  await exchange('', 510);
  expect(pulses(...ALL)).toEqual(START_POSE);
});
