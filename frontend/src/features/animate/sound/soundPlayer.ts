// Plays a sound along with the motion, on the clock of the audio hardware: scheduled ahead where the motion's way is known, moved where the
// motion was re-timed. Follows a course; knows neither who moves nor what is drawn.

import type { Clock } from '#shared/clock.ts';

/** A group that is played: it is at `atMs` at the time `sinceMs` of the clock, which may be yet to come, and continues steadily from there. */
export interface Course {
  readonly atMs: number;
  readonly sinceMs: number;
  /** ms of the group in a ms. */
  readonly rate: number;
  /** In ms of the group. */
  readonly untilMs: number;
  /** Where it continues at once then; null: nowhere, or not at once. */
  readonly thenMs: number | null;
}

/** The sound as it is now. */
export interface Playable {
  readonly buffer: AudioBuffer;
  /** In ms of the group. */
  readonly startMs: number;
}

export interface SoundPlayer {
  /** In the press that begins something: browsers let no page sound before one. */
  wake(): void;
  /** Called in each frame of the screen, and when something begins or ends; null: silence. */
  follow(course: Course | null): void;
  setMuted(isMuted: boolean): void;
}

export interface SoundPlayerOptions {
  readonly clock: Pick<Clock, 'now'>;
  createContext(): AudioContext;
  /** null: there is nothing to hear. */
  playable(): Playable | null;
}

/** Time the audio thread needs to begin something on its moment. */
const SOON_S = 0.012;
/** Playback from another place is scheduled so long before. */
const AHEAD_MS = 300;
/** A larger gap between a motion and its sound is closed: one that is smaller is heard less than that. */
const NEAR_MS = 10;
/** A course that is so far from the one before is another one. */
const FAR_MS = 60;
/** Reports of where a motion is come late now and then; the middle one of so many is believed. */
const REPORTS = 3;
/** Without it a sound that begins or ends in the middle clicks. */
const FADE_S = 0.004;

/** What was given to the audio hardware: from `fromS` of its clock on it plays the group from `atMs`. */
interface Scheduled {
  readonly playable: Playable;
  readonly fromS: number;
  readonly atMs: number;
  readonly rate: number;
  end(): void;
}

export const groupAt = ({ atMs, sinceMs, rate }: Course, nowMs: number): number =>
  atMs + (nowMs - sinceMs) * rate;

export function createSoundPlayer({ clock, createContext, playable }: SoundPlayerOptions): SoundPlayer {
  let context: AudioContext | null = null;
  let volume: GainNode | null = null;
  let muted = false;
  let current: Scheduled | null = null;
  let next: Scheduled | null = null;
  const steady = createSteady();

  function wake(): void {
    if (playable() === null) return;
    if (context === null) {
      context = createContext();
      volume = context.createGain();
      volume.gain.value = muted ? 0 : 1;
      volume.connect(context.destination);
    }
    // Refused before the first press of a person; the next press tries again.
    if (context.state !== 'running') void context.resume().catch(() => undefined);
  }

  function schedule(heard: AudioContext, course: Course, sound: Playable): Scheduled {
    const fromS = Math.max(heard.currentTime + SOON_S, contextTimeAt(heard, course.sinceMs, clock.now()));
    const atMs = groupAt(course, clockTimeAt(heard, fromS, clock.now()));
    const scheduled = { playable: sound, fromS, atMs, rate: course.rate };
    const offsetS = (atMs - sound.startMs) / 1000;
    const beginS = fromS + Math.max(0, -offsetS) / course.rate;
    const endS = fromS + (course.untilMs - atMs) / 1000 / course.rate;
    if (offsetS >= sound.buffer.duration || endS <= beginS) return { ...scheduled, end: () => undefined };
    const source = heard.createBufferSource();
    const gain = heard.createGain();
    source.buffer = sound.buffer;
    source.playbackRate.value = course.rate;
    source.connect(gain).connect(volume ?? heard.destination);
    gain.gain.setValueAtTime(offsetS > 0 ? 0 : 1, beginS);
    if (offsetS > 0) gain.gain.linearRampToValueAtTime(1, beginS + FADE_S);
    source.start(beginS, Math.max(0, offsetS));
    source.stop(endS);
    source.onended = () => gain.disconnect();
    return {
      ...scheduled,
      end() {
        const nowS = heard.currentTime;
        gain.gain.cancelScheduledValues(nowS);
        gain.gain.setValueAtTime(gain.gain.value, nowS);
        gain.gain.linearRampToValueAtTime(0, nowS + FADE_S);
        source.stop(nowS + FADE_S);
      },
    };
  }

  function silence(): void {
    current?.end();
    next?.end();
    [current, next] = [null, null];
  }

  function restart(heard: AudioContext, course: Course, sound: Playable): void {
    silence();
    current = schedule(heard, course, sound);
  }

  /** How far what sounds is ahead of the course; far where it is of another pace or of another sound. */
  function ahead(one: Scheduled, heard: AudioContext, course: Course, sound: Playable): number {
    const isSame = one.playable.buffer === sound.buffer && one.playable.startMs === sound.startMs;
    if (!isSame || one.rate !== course.rate) return Infinity;
    const nowMs = clock.now();
    const sinceMs = clockTimeAt(heard, one.fromS, nowMs);
    return (one.atMs + (nowMs - sinceMs) * one.rate - groupAt(course, nowMs)) / one.rate;
  }

  function correct(heard: AudioContext, course: Course, sound: Playable): void {
    if (next !== null && Math.abs(ahead(next, heard, course, sound)) < FAR_MS) [current, next] = [next, null];
    const offMs = current === null ? Infinity : Math.abs(ahead(current, heard, course, sound));
    if (offMs > NEAR_MS) restart(heard, course, sound);
  }

  function play(heard: AudioContext, course: Course, sound: Playable): void {
    const endMs = course.sinceMs + (course.untilMs - course.atMs) / course.rate;
    const leftMs = endMs - clock.now();
    // Past the end the next word comes from who moves.
    if (leftMs <= 0) return;
    correct(heard, course, sound);
    if (course.thenMs !== null && next === null && leftMs < AHEAD_MS)
      next = schedule(heard, { ...course, atMs: course.thenMs, sinceMs: endMs }, sound);
  }

  return {
    wake,
    follow(course) {
      const sound = playable();
      const followed = steady(course);
      if (followed === null || sound === null) silence();
      else if (context?.state === 'running') play(context, followed, sound);
    },
    setMuted(isMuted) {
      muted = isMuted;
      if (volume !== null) volume.gain.value = isMuted ? 0 : 1;
    },
  };
}

/** Each other course is a report; of those that differ little the middle one is followed, before there are three the newest. */
function createSteady(): (course: Course | null) => Course | null {
  let reported: Course | null = null;
  /** When the group would have begun, by the last reports. */
  let zerosMs: readonly number[] = [];

  function middle(): number {
    const inOrder = zerosMs.length < REPORTS ? zerosMs : zerosMs.toSorted((one, other) => one - other);
    return inOrder[Math.floor(REPORTS / 2)] ?? inOrder.at(-1) ?? 0;
  }

  function note(course: Course): void {
    const zeroMs = course.sinceMs - course.atMs / course.rate;
    // In the next pass of a loop all are so much later.
    const passMs = ((reported?.untilMs ?? 0) - (reported?.thenMs ?? reported?.untilMs ?? 0)) / course.rate;
    const isNear = (laterMs: number): boolean => Math.abs(zeroMs - laterMs - middle()) < FAR_MS;
    const isSamePace = reported?.rate === course.rate;
    const shiftMs = isSamePace ? [0, passMs].find(isNear) : undefined;
    const before = shiftMs === undefined ? [] : zerosMs.map((one) => one + shiftMs);
    zerosMs = [...before, zeroMs].slice(-REPORTS);
  }

  return (course) => {
    if (course === null) zerosMs = [];
    else if (reported === null || !isSameReport(course, reported)) note(course);
    reported = course;
    return course && { ...course, sinceMs: middle() + course.atMs / course.rate };
  };
}

const isSameReport = (one: Course, other: Course): boolean =>
  one.atMs === other.atMs && one.sinceMs === other.sinceMs && one.rate === other.rate;

// The two clocks: when the page's clock shows `clockMs`, one hears what the context plays at this time of its own.

function heardNow(
  context: AudioContext,
  nowMs: number,
): { readonly contextS: number; readonly clockMs: number } {
  const { contextTime = 0, performanceTime = 0 } = context.getOutputTimestamp();
  return performanceTime > 0
    ? { contextS: contextTime, clockMs: performanceTime }
    : { contextS: context.currentTime - (context.outputLatency || context.baseLatency), clockMs: nowMs };
}

function contextTimeAt(context: AudioContext, clockMs: number, nowMs: number): number {
  const heard = heardNow(context, nowMs);
  return heard.contextS + (clockMs - heard.clockMs) / 1000;
}

function clockTimeAt(context: AudioContext, contextS: number, nowMs: number): number {
  const heard = heardNow(context, nowMs);
  return heard.clockMs + (contextS - heard.contextS) * 1000;
}
