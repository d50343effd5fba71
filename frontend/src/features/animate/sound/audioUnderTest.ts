// Audio hardware under test: a context that plays nothing, by the clock of the test, and notes what it was given.

import type { Clock } from '#shared/clock.ts';

interface Given {
  readonly beginS: number;
  readonly offsetS: number;
  readonly rate: number;
  endS: number;
}

/** What is heard is late by so much, as on loudspeakers without wires. */
const LATENCY_S = 0.12;

export function createAudioUnderTest(clock: Pick<Clock, 'now'>) {
  const given: Given[] = [];
  let state: AudioContextState = 'suspended';
  /** The first one that is made is before all others. */
  let volume: { readonly gain: { readonly value: number } } | null = null;
  const nowS = (): number => clock.now() / 1000;
  const nothing = (): void => undefined;

  const gainNode = () => {
    const node = {
      gain: {
        value: 1,
        setValueAtTime: nothing,
        linearRampToValueAtTime: nothing,
        cancelScheduledValues: nothing,
      },
      connect: <T>(to: T): T => to,
      disconnect: nothing,
    };
    volume ??= node;
    return node;
  };

  const sourceNode = () => {
    let own: Given | null = null;
    return {
      buffer: null,
      playbackRate: { value: 1 },
      connect: <T>(to: T): T => to,
      onended: null,
      start(beginS: number, offsetS: number) {
        own = { beginS, offsetS, rate: this.playbackRate.value, endS: Infinity };
        given.push(own);
      },
      stop(endS: number) {
        if (own !== null) own.endS = Math.min(own.endS, endS);
      },
    };
  };

  const context = {
    get state() {
      return state;
    },
    get currentTime() {
      return nowS();
    },
    baseLatency: 0,
    outputLatency: LATENCY_S,
    destination: {},
    getOutputTimestamp: () => ({ contextTime: nowS() - LATENCY_S, performanceTime: clock.now() }),
    createGain: gainNode,
    createBufferSource: sourceNode,
    resume() {
      state = 'running';
      return Promise.resolve();
    },
  };

  /** Where in the sound one is by ear at a time of the clock, in ms, of all that is heard then. */
  function heardAt(atMs: number): readonly number[] {
    const atS = atMs / 1000 - LATENCY_S;
    return given
      .filter(({ beginS, endS }) => atS >= beginS && atS < endS)
      .map(({ beginS, offsetS, rate }) => (offsetS + (atS - beginS) * rate) * 1000);
  }

  return {
    context: context as unknown as AudioContext,
    given,
    heardAt,
    volume: (): number => volume?.gain.value ?? 1,
  };
}
