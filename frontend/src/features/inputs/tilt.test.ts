// The tilt of a device as an input: by events as browsers send them, and only while it is held.

import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { evenly } from '#shared/testing/cases.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createTilt, tiltBetween, type TiltPage, upOf } from './TiltControls.tsx';

const up = (beta: number, gamma: number) => upOf({ beta, gamma })!;

/** In hundredths, sideways and forward. */
function tilted(before: readonly [number, number], now: readonly [number, number], screenDegrees = 0) {
  const tilt = tiltBetween(up(...before), up(...now), screenDegrees);
  return [tilt?.sideways, tilt?.forward].map((way) => Math.round((way ?? NaN) * 100) + 0);
}

describe('the tilt between two poses', () => {
  test('flat on a hand, the right edge down is to the right and the top edge down is forward', () => {
    expect(tilted([0, 0], [0, 15])).toEqual([50, 0]);
    expect(tilted([0, 0], [-15, 0])).toEqual([0, 50]);
  });

  test('the same from the pose in which a person looks at it, and upright like a wheel', () => {
    expect(tilted([50, 0], [35, 0])).toEqual([0, 50]);
    expect(tilted([90, 0], [75, 90])).toEqual([50, 0]);
  });

  test('turned by a quarter, right and forward are those of the picture', () => {
    expect(tilted([0, 0], [15, 0], 90)).toEqual([50, 0]);
    expect(tilted([0, 0], [0, -15], 270)).toEqual([0, 50]);
  });

  test('nothing at the pose of the press, all of it at most, and the other way is the opposite', () => {
    const angle = evenly(-80, 80);
    fc.assert(
      fc.property(angle, angle, angle, angle, (beta, gamma, beta2, gamma2) => {
        const [one, other] = [up(beta, gamma), up(beta2, gamma2)];
        const still = tiltBetween(one, one, 0);
        if (still !== null) expect(Object.values(still).every((way) => Math.abs(way) < 1e-6)).toBe(true);
        const moved = tiltBetween(one, other, 0);
        for (const way of Object.values(moved ?? {})) expect(Math.abs(way)).toBeLessThanOrEqual(1);
      }),
    );
  });
});

function pageWith(more: Partial<TiltPage> = {}, hasSensor = true) {
  const events = new EventTarget();
  const clock = createVirtualClock();
  const page: TiltPage = {
    ...{ isSecureContext: true, screen: { orientation: { angle: 0 } } },
    ...(hasSensor && { DeviceOrientationEvent: {} }),
    addEventListener: (name, listener) => events.addEventListener(name, listener),
    removeEventListener: (name, listener) => events.removeEventListener(name, listener),
    ...more,
  };
  const tilt = createTilt(page, clock);
  return {
    ...{ tilt, clock },
    state: () => tilt.store.getState(),
    turn: (beta: number | null, gamma: number | null) =>
      events.dispatchEvent(Object.assign(new Event('deviceorientation'), { beta, gamma })),
    blur: () => events.dispatchEvent(new Event('blur')),
  };
}

describe('the button that makes a tilt count', () => {
  test('counts from the pose at the press, and not a moment longer than it is held', () => {
    const { tilt, turn, state } = pageWith();
    turn(40, 0);
    expect(tilt.read()).toBeNull();
    tilt.press();
    expect(tilt.read()).toBeNull();
    turn(40, 0);
    expect(tilt.read()?.forward).toBeCloseTo(0);
    turn(25, 0);
    expect(tilt.read()?.forward).toBeCloseTo(0.5);
    tilt.release();
    expect(tilt.read()).toBeNull();
    expect(state()).toBe('ready');
    turn(25, 0);
    tilt.press();
    turn(25, 0);
    expect(tilt.read()?.forward).toBeCloseTo(0);
  });

  test('leaving the window releases it', () => {
    const { tilt, turn, blur } = pageWith();
    tilt.press();
    turn(0, 0);
    turn(0, 20);
    blur();
    turn(0, 20);
    expect(tilt.read()).toBeNull();
  });

  test('a sensor that falls silent counts no more, and one that never speaks is reported', async () => {
    const { tilt, turn, clock, state } = pageWith();
    tilt.press();
    turn(0, 0);
    turn(0, 20);
    await clock.advance(1500);
    expect(tilt.read()).toBeNull();
    tilt.release();
    tilt.press();
    turn(null, null);
    await clock.advance(1500);
    expect(state()).toBe('silent');
  });

  test('says why there is no tilt, and begins nothing', async () => {
    const insecure = pageWith({ isSecureContext: false });
    insecure.tilt.press();
    expect(insecure.state()).toBe('insecure');
    expect(pageWith({}, false).state()).toBe('missing');
    const answers = ['denied', 'granted'];
    const asking = () =>
      pageWith({
        DeviceOrientationEvent: { requestPermission: () => Promise.resolve(answers.shift() ?? '') },
      });
    const refused = asking();
    expect(refused.state()).toBe('permission');
    refused.tilt.press();
    expect(refused.state()).toBe('permission');
    await refused.tilt.request();
    expect(refused.state()).toBe('refused');
    const granted = asking();
    await granted.tilt.request();
    expect(granted.state()).toBe('ready');
  });
});
