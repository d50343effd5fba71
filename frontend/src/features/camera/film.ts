// The film of a motion: pictures of the camera, each at its time in the group, taken while the robot plays. Bounded in time and bytes, and lost
// with the page. Knows no camera and shows nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Stores } from '../stores.ts';

const MEBIBYTE = 1024 * 1024;

export const FILM = {
  picturesPerS: 15,
  /** In the time of the group, of which each moment has one picture. */
  longestS: 60,
  mostMebibytes: 48,
  /** Of the longer side. */
  sidePx: 640,
} as const;

export const STEP_MS = 1000 / FILM.picturesPerS;
/** An older picture is not of that moment. */
const LONGEST_GAP = 2 * FILM.picturesPerS;

export interface FilmPicture {
  readonly atMs: number;
  readonly jpeg: Blob;
}

interface Taken extends FilmPicture {
  readonly pass: number;
}

export interface FilmState {
  /** Each motion that plays is filmed, in place of the film before. */
  readonly isOn: boolean;
  readonly isFilming: boolean;
  /** In place of the camera's picture. */
  readonly isShown: boolean;
  readonly count: number;
  readonly mebibytes: number;
  readonly fromMs: number;
  readonly toMs: number;
  /** Its bound was reached. */
  readonly isFull: boolean;
}

interface Size {
  readonly width: number;
  readonly height: number;
}

type Encode = (picture: CanvasImageSource, size: Size) => Promise<Blob>;

export interface Film {
  readonly store: StoreApi<FilmState>;
  set(isOn: boolean): void;
  show(isShown: boolean): void;
  /** To be called with each new picture of the camera; takes it where the moment has none yet. */
  take(picture: CanvasImageSource, size: Size): Promise<void>;
  /** The picture of that time in the group; null where there is none. */
  at(atMs: number): FilmPicture | null;
  all(): readonly FilmPicture[];
  clear(): void;
}

export type FilmStores = Pick<Stores, 'playback' | 'playhead'> & {
  readonly library: { readonly store: Pick<StoreApi<{ readonly openId: string }>, 'subscribe'> };
};

type Phase = ReturnType<Stores['playback']['store']['getState']>['phase'];

const EMPTY = { count: 0, mebibytes: 0, fromMs: 0, toMs: 0, isFull: false, isShown: false } as const;

/** On its way to the first pose, or back to it, the robot is nowhere in the group. */
const FILMED: readonly Phase[] = ['playing', 'recording', 'running'];
const MOVES_NOTHING: readonly Phase[] = [null, 'previewing'];

export const isRobotPlaying = (phase: Phase): boolean => !MOVES_NOTHING.includes(phase);

const all = new WeakMap<FilmStores['playback'], Film>();

/** The one of these stores, made when it is first needed. */
export function filmOf(stores: FilmStores): Film {
  const made = all.get(stores.playback) ?? createFilm(stores, toJpeg);
  all.set(stores.playback, made);
  return made;
}

export function createFilm({ playback, playhead, library }: FilmStores, encode: Encode): Film {
  const store = createStore<FilmState>(() => ({ ...EMPTY, isOn: false, isFilming: false }));
  /** By the number of the moment. */
  let pictures = new Map<number, Taken>();
  let bytes = 0;
  let pass = 0;
  let lastMoment = 0;
  let isEncoding = false;

  const momentOf = (atMs: number): number => Math.floor(atMs / STEP_MS);

  function clear(): void {
    pictures = new Map<number, Taken>();
    [bytes, pass, lastMoment] = [0, 0, 0];
    store.setState(EMPTY);
  }

  const follow = (): void =>
    store.setState(({ isOn }) => ({ isFilming: isOn && FILMED.includes(playback.store.getState().phase) }));

  playback.store.subscribe(({ phase }, { phase: before }) => {
    if (phase === before) return;
    const { isOn, isFilming, count } = store.getState();
    if (isOn && isRobotPlaying(phase) && !isRobotPlaying(before)) clear();
    if (isFilming && !isRobotPlaying(phase)) store.setState({ isShown: count > 0 });
    follow();
  });
  library.store.subscribe(({ openId }, before) => {
    if (openId !== before.openId) clear();
  });

  function put(moment: number, picture: Taken): void {
    const replaced = pictures.get(moment);
    const after = bytes - (replaced?.jpeg.size ?? 0) + picture.jpeg.size;
    const isTooMuch =
      after > FILM.mostMebibytes * MEBIBYTE ||
      (replaced === undefined && pictures.size >= FILM.longestS * FILM.picturesPerS);
    if (isTooMuch) return store.setState({ isFull: true });
    bytes = after;
    pictures.set(moment, picture);
    const { count, fromMs, toMs } = store.getState();
    store.setState({
      count: pictures.size,
      mebibytes: bytes / MEBIBYTE,
      fromMs: count === 0 ? picture.atMs : Math.min(fromMs, picture.atMs),
      toMs: Math.max(toMs, picture.atMs),
    });
  }

  return {
    store,
    set(isOn) {
      if (isOn && isRobotPlaying(playback.store.getState().phase)) clear();
      store.setState({ isOn });
      follow();
    },
    show: (isShown) => store.setState({ isShown }),
    async take(picture, size) {
      if (!store.getState().isFilming || isEncoding) return;
      const atMs = playhead.at();
      const moment = momentOf(atMs);
      // Each later pass takes the place of the one before, moment by moment.
      if (moment < lastMoment) pass += 1;
      lastMoment = moment;
      if (pictures.get(moment)?.pass === pass) return;
      const of = pictures;
      const own = pass;
      isEncoding = true;
      try {
        const jpeg = await encode(picture, size);
        if (of === pictures) put(moment, { atMs, jpeg, pass: own });
      } finally {
        isEncoding = false;
      }
    },
    at(atMs) {
      const moment = momentOf(atMs);
      for (let back = 0; back <= LONGEST_GAP; back += 1) {
        const found = pictures.get(moment - back);
        if (found !== undefined) return found;
      }
      return null;
    },
    all: () => [...pictures.values()].toSorted((one, other) => one.atMs - other.atMs),
    clear,
  };
}

function toJpeg(picture: CanvasImageSource, { width, height }: Size): Promise<Blob> {
  const scale = Math.min(1, FILM.sidePx / Math.max(width, height));
  const canvas = new OffscreenCanvas(Math.round(width * scale), Math.round(height * scale));
  canvas.getContext('2d')?.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return canvas.convertToBlob({ type: 'image/jpeg', quality: 0.75 });
}
