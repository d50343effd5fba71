// The tilt of a phone or tablet as an input: how far it is turned from where it was when the button was pressed, and the button. It counts only
// while the button is held. Knows no servo and no binding.

import { type PointerEvent, useEffect, useState } from 'react';
import { createStore, type StoreApi, useStore } from 'zustand';
import type { Clock } from '#shared/clock.ts';
import { added, cross, dot, lengthOf, scaled, type Vec3 } from '#shared/kinematics/model.ts';
import type { Tilt } from '#shared/profile/mapping.ts';
import { words } from '../../i18n/whole.ts';
import { Button } from '../../ui/Button.tsx';
import { usePad, useStores } from '../stores.ts';
import styles from './PadPanel.module.css';

/** As in `DeviceOrientationEvent`, in degrees; null without a sensor. */
export interface Orientation {
  readonly beta: number | null;
  readonly gamma: number | null;
}

const RADIANS = Math.PI / 180;
/** So far is all the way: a wrist turns it without effort. */
const FULL = 30 * RADIANS;
/** Of a unit vector: less is up or down, and says nothing of right and left. */
const LEAST_LEVEL = 0.2;

/** Which way is up, in the frame of the device: x to the right of its screen, y to its top, z out of it. */
export function upOf({ beta, gamma }: Orientation): Vec3 | null {
  if (beta === null || gamma === null) return null;
  const [pitch, roll] = [beta * RADIANS, gamma * RADIANS];
  return [-Math.cos(pitch) * Math.sin(roll), Math.sin(pitch), Math.cos(pitch) * Math.cos(roll)];
}

/**
 * How far it was turned, about axes that were level at first, so that it does not matter how it was held. `screenDegrees`: how its
 * picture is turned on it. null: it stood on its side.
 */
export function tiltBetween(before: Vec3, now: Vec3, screenDegrees: number): Tilt | null {
  const turn = screenDegrees * RADIANS;
  const right: Vec3 = [Math.cos(turn), -Math.sin(turn), 0];
  const level = added(right, scaled(before, -dot(right, before)));
  const length = lengthOf(level);
  if (length < LEAST_LEVEL) return null;
  const across = scaled(level, 1 / length);
  const turned = cross(now, before);
  const sine = lengthOf(turned);
  const full = sine === 0 ? 0 : Math.atan2(sine, dot(now, before)) / sine / FULL;
  const part = (axis: Vec3): number => Math.min(1, Math.max(-1, dot(turned, axis) * full));
  return { sideways: part(cross(before, across)), forward: part(scaled(across, -1)) };
}

/** `silent`: held, and nothing reports a tilt. */
export type TiltState = 'insecure' | 'missing' | 'permission' | 'refused' | 'ready' | 'held' | 'silent';

/** The part of `window` in use. */
export interface TiltPage {
  readonly isSecureContext: boolean;
  readonly DeviceOrientationEvent?: { requestPermission?(): Promise<string> };
  readonly screen: { readonly orientation?: { readonly angle: number } };
  addEventListener(name: string, listener: (event: Event) => void): void;
  removeEventListener(name: string, listener: (event: Event) => void): void;
}

export interface TiltInput {
  readonly store: StoreApi<TiltState>;
  /** From a press; some browsers show a question. */
  request(): Promise<void>;
  press(): void;
  release(): void;
  /** null: it does not count now. */
  read(): Tilt | null;
}

/** A sensor that has reported nothing for so long is not trusted. */
const STALE_MS = 1000;

export function createTilt(page: TiltPage, clock: Clock): TiltInput {
  const store = createStore<TiltState>(() => stateAtFirst(page));
  let first: Vec3 | null = null;
  let last: { readonly up: Vec3; readonly atMs: number } | null = null;
  let screenDegrees = 0;
  let cancel = (): void => undefined;

  function hear(event: Event): void {
    const up = upOf(event as Event & Orientation);
    if (up === null) return;
    cancel();
    first ??= up;
    last = { up, atMs: clock.now() };
    store.setState('held', true);
  }

  function release(): void {
    cancel();
    page.removeEventListener('deviceorientation', hear);
    for (const name of ['blur', 'pagehide']) page.removeEventListener(name, release);
    [first, last] = [null, null];
    if (store.getState() === 'held') store.setState('ready', true);
  }

  return {
    store,
    async request() {
      const given = await page.DeviceOrientationEvent?.requestPermission?.().catch(() => 'denied');
      store.setState(given === 'granted' ? 'ready' : 'refused', true);
    },
    press() {
      if (!['ready', 'silent'].includes(store.getState())) return;
      screenDegrees = page.screen.orientation?.angle ?? 0;
      store.setState('held', true);
      page.addEventListener('deviceorientation', hear);
      for (const name of ['blur', 'pagehide']) page.addEventListener(name, release);
      cancel = clock.after(STALE_MS, () => store.setState('silent', true));
    },
    release,
    read() {
      if (first === null || last === null || clock.now() - last.atMs > STALE_MS) return null;
      return tiltBetween(first, last.up, screenDegrees);
    },
  };
}

function stateAtFirst({ isSecureContext, DeviceOrientationEvent: sensor }: TiltPage): TiltState {
  if (!isSecureContext) return 'insecure';
  if (sensor === undefined) return 'missing';
  return sensor.requestPermission === undefined ? 'ready' : 'permission';
}

export function TiltControls() {
  const { pad, device } = useStores();
  const [tilt] = useState(() => createTilt(window as unknown as TiltPage, device.clock));
  const state = useStore(tilt.store);
  const isDriving = usePad((one) => one.isDriving);
  useEffect(() => {
    pad.tiltBy(tilt.read);
    return () => {
      tilt.release();
      pad.tiltBy(null);
    };
  }, [pad, tilt]);

  function press(event: PointerEvent<HTMLButtonElement>): void {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    tilt.press();
  }

  const canHold = state === 'ready' || state === 'held' || state === 'silent';
  return (
    <div className={styles.tilt} role="group" aria-label={words.pad.tilt.title}>
      {state === 'permission' && <Button onPress={() => void tilt.request()}>{words.pad.tilt.allow}</Button>}
      {canHold && (
        <button
          type="button"
          className={styles.hold}
          data-held={state === 'held'}
          onPointerDown={press}
          onPointerUp={tilt.release}
          onPointerCancel={tilt.release}
          onLostPointerCapture={tilt.release}
          onContextMenu={(event) => event.preventDefault()}
          onKeyDown={({ key, repeat }) => (key === ' ' || key === 'Enter') && !repeat && tilt.press()}
          onKeyUp={tilt.release}
          onBlur={tilt.release}
        >
          {words.pad.tilt.hold}
        </button>
      )}
      <p role="status">{hintFor(state, isDriving)}</p>
    </div>
  );
}

function hintFor(state: TiltState, isDriving: boolean): string {
  if (state !== 'ready' && state !== 'held') return words.pad.tilt[state];
  return isDriving ? words.pad.tilt.hint : words.pad.tilt.off;
}
