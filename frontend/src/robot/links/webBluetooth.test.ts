// A session over Web Bluetooth against a module that fails at every step, by every name, or never answers: each failure ends in a
// state with a code, and the link can be brought back. What goes through a module is what goes through a cable.

import fc from 'fast-check';
import { beforeEach, describe, expect, test, vi } from 'vitest';
import { createDecoder, type DecoderEvent } from '#shared/codec/decoder.ts';
import { fromHex, wireMs } from '#shared/codec/packet.ts';
import type { LinkErrorCode } from '#shared/robot/linkError.ts';
import reports from '../../../../shared/protocol/vectors/reports.json' with { type: 'json' };
import {
  chooseCharacteristics,
  chunksOf,
  createGatherer,
  type Offered,
  chooseModule,
  createWebBluetoothChannel,
  lookForBluetooth,
  moduleLabel,
} from './webBluetooth.ts';
import { createModule, FFF0, STEPS, type FakeModule, type Step } from './bluetoothUnderTest.ts';
import {
  BACK_MS,
  BATTERY_REPORT,
  expectUse,
  freshBrowser,
  openChannel,
  outcome,
  pass,
  type Tab,
} from './tabUnderTest.ts';

const NAMES = [
  'NetworkError',
  'InvalidStateError',
  'NotSupportedError',
  'SecurityError',
  'UnknownError',
] as const;
const CONNECT_MS = 10_000;
const STOP = [0x55, 0x55, 0x02, 0x07];

const it = freshBrowser();
let fake: FakeModule;
beforeEach(() => {
  useModule(createModule());
  vi.stubGlobal('window', { isSecureContext: true });
});

function useModule(next: FakeModule): void {
  fake = next;
  vi.stubGlobal('navigator', { ...it.browser.navigator, bluetooth: fake.bluetooth });
}

const openTab = (): Tab => openChannel(createWebBluetoothChannel(fake.module));

async function openReady(): Promise<Tab> {
  const tab = openTab();
  await pass(50);
  expect(outcome(tab)).toBe('ready');
  return tab;
}

const sent = (): number[] => fake.written.flatMap(({ bytes }) => [...bytes]);

describe.each(STEPS)('at %s', (step: Step) => {
  test.each([...NAMES, 'never settles'] as const)(
    '%s ends in a state, and the link comes back',
    async (name) => {
      const failure = name === 'never settles' ? name : new DOMException('made for a test', name);
      const isAtWriting = step === 'write';
      const tab = isAtWriting ? await openReady() : null;
      fake.failNext(step, failure);
      const failed = tab ?? openTab();
      if (isAtWriting) failed.session.move([{ servo: 1, position: 1500 }], 100);
      await pass(name === 'never settles' ? CONNECT_MS + 200 : 200);
      const expected: LinkErrorCode = isAtWriting
        ? 'lost'
        : name === 'SecurityError'
          ? 'portDenied'
          : 'moduleMissing';
      expect(failed.outcomes).toContain(expected);

      if (outcome(failed) !== 'ready') failed.session.retryNow();
      await pass(BACK_MS);
      expect(outcome(failed)).toBe('ready');
      expect(fake.isConnected()).toBe(true);
      await expectUse(failed, fake);
    },
  );
});

test('a link that the radio lost is reported at once and comes back by itself', async () => {
  const tab = await openReady();
  fake.drop();
  await pass(1);
  expect(outcome(tab)).toBe('lost');
  await pass(1000);
  expect(outcome(tab)).toBe('ready');
  await expectUse(tab, fake);
});

test('an adapter that is switched off says so, and on again the link is tried at once', async () => {
  const tab = await openReady();
  fake.power(false);
  await pass(30_000);
  expect(outcome(tab)).toBe('bluetoothOff');
  fake.power(true);
  await pass(BACK_MS);
  expect(outcome(tab)).toBe('ready');
});

test('a device of another kind is left alone', async () => {
  useModule(createModule([['2a00', ['notify', 'write']]]));
  const tab = openTab();
  await pass(100);
  expect(outcome(tab)).toBe('otherDevice');
  expect(fake.isConnected()).toBe(false);
});

test('a link that is given up while it connects stays given up', async () => {
  fake.failNext('connect', 'never settles');
  const tab = openTab();
  await pass(100);
  const closed = tab.session.close();
  await pass(CONNECT_MS);
  await closed;
  expect(outcome(tab)).toBe('closed');
  expect(fake.isConnected()).toBe(false);
});

test.each([
  { characteristics: undefined, method: 'writeValueWithoutResponse' },
  { characteristics: FFF0, method: 'writeValueWithResponse' },
])('$method where a module offers that', async ({ characteristics, method }) => {
  useModule(createModule(characteristics));
  const tab = await openReady();
  tab.session.move([{ servo: 1, position: 1500 }], 100);
  await pass(100);
  expect(fake.written.length).toBeGreaterThan(0);
  expect(new Set(fake.written.map((one) => one.method))).toEqual(new Set([method]));
});

test('a page that goes hands its stop over behind the pieces of what is leaving', async () => {
  const channel = createWebBluetoothChannel(fake.module);
  await channel.open();
  const packet = Uint8Array.from({ length: 50 }, (_, index) => index);
  void channel.write(packet).catch(() => undefined);
  await pass(1);
  void channel.close(Uint8Array.from(STOP));
  // No timer of a page that is gone comes due.
  for (let turn = 0; turn < 50; turn += 1) await Promise.resolve();
  expect(sent()).toEqual([...packet, ...STOP]);
});

test('a packet takes the time of the UART behind the module', async () => {
  const channel = createWebBluetoothChannel(fake.module);
  await channel.open();
  const startMs = performance.now();
  let leftMs = 0;
  void channel.write(new Uint8Array(50)).then(() => (leftMs = performance.now() - startMs));
  await pass(500);
  expect(leftMs).toBeGreaterThanOrEqual(wireMs(50) - 1);
  expect(leftMs).toBeLessThanOrEqual(wireMs(50) + 3);
});

describe('what goes through a module is what goes through a cable', () => {
  const anyPacket = fc
    .uint8Array({ minLength: 0, maxLength: 60 })
    .map((params) => Uint8Array.of(0x55, 0x55, params.length + 2, 3, ...params));

  test('out', () => {
    fc.assert(
      fc.property(anyPacket, (packet) => {
        const chunks = chunksOf(packet);
        expect(chunks.every(({ length }) => length > 0 && length <= 20)).toBe(true);
        expect(chunks.flatMap((chunk) => [...chunk])).toEqual([...packet]);
      }),
    );
  });

  /** As the session does it: a silence of 20 ms is a pause, of 60 ms the end. */
  function decoded(bytes: readonly { readonly atMs: number; readonly piece: Uint8Array }[]): DecoderEvent[] {
    const events: DecoderEvent[] = [];
    const decoder = createDecoder((event) => events.push(event));
    bytes.forEach(({ atMs, piece }, index) => {
      decoder.push(piece);
      const silenceMs = (bytes[index + 1]?.atMs ?? Infinity) - atMs;
      if (silenceMs >= 20) decoder.pause();
      if (silenceMs >= 60) decoder.idle();
    });
    return events;
  }

  test('in, however slow the radio is between two notifications of a report', async () => {
    const report = Uint8Array.of(
      0x55,
      0x55,
      21,
      21,
      6,
      ...[1, 2, 3, 4, 5, 6].flatMap((servo) => [servo, 0xdc, 5]),
    );
    const heard: { atMs: number; piece: Uint8Array }[] = [];
    const gather = createGatherer((piece) => heard.push({ atMs: performance.now(), piece }));
    gather(report.slice(0, 20));
    await pass(120);
    gather(report.slice(20));
    await pass(300);
    expect(decoded(heard)).toEqual(decoded([{ atMs: 0, piece: report }]));
  });

  test('in, however the radio cuts and delays packets: those that a serial line gives', async () => {
    const packets = reports.map(({ hex }) => fromHex(hex));
    const delays = fc.array(fc.integer({ min: 0, max: 140 }), { minLength: 13, maxLength: 13 });
    await fc.assert(
      fc.asyncProperty(
        fc.array(fc.tuple(fc.constantFrom(...packets), delays), { maxLength: 5 }),
        async (said) => {
          const heard: { atMs: number; piece: Uint8Array }[] = [];
          const gather = createGatherer((piece) => heard.push({ atMs: performance.now(), piece }));
          for (const [packet, delaysMs] of said) {
            for (const [index, piece] of chunksOf(packet).entries()) {
              await pass(delaysMs[index] ?? 0);
              gather(piece);
            }
            await pass(300);
          }
          const serial = said.map(([piece], index) => ({ atMs: index * 300, piece }));
          expect(decoded(heard)).toEqual(decoded(serial));
        },
      ),
    );
  });

  test('in, in whatever pieces', async () => {
    const pieces = fc.array(
      fc.tuple(fc.integer({ min: 0, max: 300 }), fc.uint8Array({ minLength: 1, maxLength: 20 })),
    );
    await fc.assert(
      fc.asyncProperty(pieces, async (list) => {
        const heard: number[] = [];
        const gather = createGatherer((bytes) => heard.push(...bytes));
        for (const [pauseMs, piece] of list) {
          await pass(pauseMs);
          gather(piece);
        }
        await pass(500);
        expect(heard).toEqual(list.flatMap(([, piece]) => [...piece]));
      }),
    );
  });
});

test('characteristics are chosen by what they can do', () => {
  const offered = (short: string, ...able: readonly string[]): Offered => ({
    uuid: `0000${short}-0000-1000-8000-00805f9b34fb`,
    properties: {
      notify: able.includes('notify'),
      write: able.includes('write'),
      writeWithoutResponse: able.includes('fast'),
    },
  });
  const both = offered('ffe1', 'notify', 'fast');
  const notifier = offered('ffe1', 'notify');
  const writer = offered('ffe2', 'write');
  const other = offered('2a00', 'notify', 'write');
  expect(chooseCharacteristics([writer, both])).toEqual({ notifies: both, takes: both });
  expect(chooseCharacteristics([other, writer, notifier])).toEqual({ notifies: notifier, takes: writer });
  expect(chooseCharacteristics([other, notifier])).toBeNull();
});

describe('what the browser says', () => {
  test.each([
    ['NotFoundError', true, 'moduleNotChosen'],
    ['AbortError', true, 'moduleNotChosen'],
    ['NotFoundError', false, 'bluetoothOff'],
    ['SecurityError', true, 'portDenied'],
  ] as const)('a chooser that ends with %s where there is an adapter (%s): %s', async (name, isOn, code) => {
    const requestDevice = (): Promise<never> => Promise.reject(new DOMException('made for a test', name));
    Object.assign(fake.bluetooth, { requestDevice });
    fake.power(isOn);
    await expect(chooseModule()).rejects.toMatchObject({ code });
  });

  test('why there is no Bluetooth, and which modules were chosen before', async () => {
    expect(await lookForBluetooth()).toEqual({ obstacle: null, granted: [] });
    Object.assign(fake.bluetooth, { getDevices: () => Promise.resolve([fake.module]) });
    expect(await lookForBluetooth()).toEqual({
      obstacle: null,
      granted: [{ module: fake.module, label: 'Hiwonder wQ8x' }],
    });
    fake.power(false);
    expect((await lookForBluetooth()).obstacle).toBe('bluetoothOff');
    vi.stubGlobal('navigator', it.browser.navigator);
    expect((await lookForBluetooth()).obstacle).toBe('unsupported');
    vi.stubGlobal('window', { isSecureContext: false });
    expect((await lookForBluetooth()).obstacle).toBe('insecureAddress');
  });

  test('two robots of one name are distinguished', () => {
    expect(moduleLabel(createModule().module)).not.toBe(
      moduleLabel(createModule(undefined, 'Zr0q==').module),
    );
  });
});

test('a battery question is answered', async () => {
  const tab = await openReady();
  const answer = tab.session.readBattery();
  await pass(20);
  fake.deliver(...BATTERY_REPORT);
  await pass(50);
  await expect(answer).resolves.toBe(7500);
});
