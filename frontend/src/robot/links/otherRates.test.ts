import { expect, test } from 'vitest';
import type { FakePort } from './serialUnderTest.ts';
import { BATTERY_REPORT, freshBrowser, pass } from './tabUnderTest.ts';
import { findRate, type HeardAtRate } from './otherRates.ts';

const it = freshBrowser();
const ANYTHING = ({ packets, noise }: HeardAtRate): boolean => packets + noise.length > 0;

/** Until it has listened at all speeds. */
async function found(port: FakePort): Promise<HeardAtRate | null> {
  const search = findRate(port.port, ANYTHING);
  await pass(20_000);
  return search;
}

test('a board that sends at another speed is found at it, and the port is free again', async () => {
  const port = it.browser.plugIn();
  let wasSaid = false;
  port.whenRead = () => {
    if (port.baud() !== 57_600 || wasSaid) return;
    wasSaid = true;
    port.deliver(...BATTERY_REPORT);
  };
  const heard = await found(port);
  expect(heard?.baud).toBe(57_600);
  expect(heard?.packets).toBeGreaterThan(0);
  expect(port.isOpen()).toBe(false);
  expect(port.written).toEqual([]);
});

test('a line that errs at the wrong speeds is listened to until the right one', async () => {
  const port = it.browser.plugIn();
  let reads = 0;
  let wasSaid = false;
  port.whenRead = () => {
    reads += 1;
    if (port.baud() === 38_400) {
      if (!wasSaid) port.deliver(0x72, 0x73, 0x74);
      wasSaid = true;
    } else if (reads % 2 === 1) port.disturb(new DOMException('made for a test', 'FramingError'));
  };
  expect(await found(port)).toEqual({ baud: 38_400, packets: 0, noise: [0x72, 0x73, 0x74] });
});

test('silence at every speed is no finding', async () => {
  expect(await found(it.browser.plugIn())).toBeNull();
});
