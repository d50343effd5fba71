// The film beside the playhead: its switch, the picture of the playhead's time in place of the camera's, a slider that steps both, and the film as
// a file. Takes no picture; moves nothing.

import { useEffect, useRef, type RefObject } from 'react';
import { useStore } from 'zustand';
import { words } from '../../i18n/whole.ts';
import { IconButton } from '../../ui/Button.tsx';
import { saveBlob } from '../../ui/localFiles.tsx';
import { Choice, Toggle } from '../../ui/Toggle.tsx';
import { useDocument, usePlayback, useStores, useTimeline, useView } from '../stores.ts';
import { FILM, type Film, filmOf, type FilmState, isRobotPlaying, STEP_MS } from './film.ts';
import styles from './Film.module.css';

/** It is shown where the timeline is, and never while the robot plays. */
export function useShownFilm(): Film | null {
  const film = filmOf(useStores());
  const isShown = useStore(film.store, (state) => state.isShown);
  const isPlaying = usePlayback(({ phase }) => isRobotPlaying(phase));
  const isBeside = useView(({ tab }) => tab === 'actions');
  return isShown && isBeside && !isPlaying ? film : null;
}

export function FilmPicture({ film, className }: { readonly film: Film; readonly className: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const picture = useTimeline(({ playheadMs }) => film.at(playheadMs));
  useEffect(() => {
    let isOld = false;
    if (picture !== null) void draw(picture.jpeg, canvas, () => isOld);
    return () => void (isOld = true);
  }, [picture]);
  return (
    <div className={`${className} ${styles.shown}`}>
      <canvas
        ref={canvas}
        className={styles.picture}
        hidden={picture === null}
        role="img"
        aria-label={words.camera.film.picture({ ms: picture?.atMs ?? 0 })}
      />
      {picture === null && <p className={styles.gap}>{words.camera.film.gap}</p>}
      <span className={styles.mark}>{words.camera.film.film}</span>
    </div>
  );
}

async function draw(
  jpeg: Blob,
  canvas: RefObject<HTMLCanvasElement | null>,
  isOld: () => boolean,
): Promise<void> {
  const bitmap = await createImageBitmap(jpeg);
  const place = canvas.current;
  if (place !== null && !isOld()) {
    Object.assign(place, { width: bitmap.width, height: bitmap.height });
    place.getContext('2d')?.drawImage(bitmap, 0, 0);
  }
  bitmap.close();
}

/** Below the camera's picture, where the timeline is. */
export function FilmRow({ className }: { readonly className: string }) {
  const film = filmOf(useStores());
  const { isOn, isShown, isFilming, count } = useStore(film.store, (state) => state);
  const isBeside = useView(({ tab }) => tab === 'actions');
  const hasFilm = count > 0 && !isFilming;
  if (!isBeside) return null;
  return (
    <div className={`${className} ${styles.row}`} role="group" aria-label={words.camera.film.film}>
      <Toggle label={words.camera.film.film} isOn={isOn} onChange={film.set} />
      {hasFilm && (
        <>
          <Choice
            label={words.camera.film.shown}
            value={isShown ? 'film' : 'live'}
            options={(['live', 'film'] as const).map((value) => ({
              value,
              label: words.camera.film.pictures[value],
            }))}
            onChange={(value) => film.show(value === 'film')}
          />
          <SaveAndDelete film={film} />
        </>
      )}
      {hasFilm && isShown && <Scrub film={film} />}
      <Facts film={film} />
    </div>
  );
}

/** The playhead goes along. Its step is one picture. */
function Scrub({ film }: { readonly film: Film }) {
  const { playhead } = useStores();
  const { fromMs, toMs } = useStore(film.store, (state) => state);
  const atMs = useTimeline(({ playheadMs }) => Math.min(toMs, Math.max(fromMs, playheadMs)));
  return (
    <input
      type="range"
      className={styles.scrub}
      aria-label={words.camera.film.position}
      aria-valuetext={words.camera.film.at({ ms: atMs })}
      min={fromMs}
      max={toMs}
      step={STEP_MS}
      value={atMs}
      onChange={({ target }) => playhead.show(Math.round(target.valueAsNumber))}
    />
  );
}

function Facts({ film }: { readonly film: Film }) {
  const text = useStore(film.store, factsOf);
  return text === '' ? null : (
    <p className={styles.facts} role="status">
      {text}
    </p>
  );
}

/** The bound is said before it is reached. */
function factsOf({ isOn, isFilming, isFull, count, mebibytes, fromMs, toMs }: FilmState): string {
  const said = words.camera.film;
  const bound = { longestS: FILM.longestS, most: FILM.mostMebibytes };
  if (isFull) return said.full({ ...bound, count });
  if (isFilming) return said.filming({ count });
  if (count > 0) return said.done({ fromMs, toMs, count, mebibytes: Math.ceil(mebibytes), most: bound.most });
  return isOn ? said.waits(bound) : '';
}

function SaveAndDelete({ film }: { readonly film: Film }) {
  const name = useDocument(({ present }) => present.name);
  return (
    <span className={styles.acts}>
      <IconButton icon="save" label={words.camera.film.save} onPress={() => void save(film, name)} />
      <IconButton icon="trash" label={words.camera.film.delete} onPress={film.clear} />
    </span>
  );
}

/** Each picture is named by its time in the group, in ms. */
async function save(film: Film, name: string): Promise<void> {
  const { zipSync } = await import('fflate');
  const files = await Promise.all(
    film.all().map(async ({ atMs, jpeg }) => {
      const bytes = new Uint8Array(await jpeg.arrayBuffer());
      return [`${String(Math.round(atMs)).padStart(6, '0')} ms.jpg`, [bytes, { level: 0 }]] as const;
    }),
  );
  const zip = zipSync(Object.fromEntries(files) as unknown as Parameters<typeof zipSync>[0]);
  saveBlob(`${name === '' ? 'film' : name}.zip`, new Blob([zip], { type: 'application/zip' }));
}
