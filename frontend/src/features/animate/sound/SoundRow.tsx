// The row of the group's sound above the tracks: its loudness and beats over the same time as the keys. It is dragged, or moved with the arrow
// keys, to begin earlier or later; what else can be done with it is in its menu.

import { type KeyboardEvent, memo, type ReactNode, useEffect, useRef, useState } from 'react';
import { useStore } from 'zustand';
import { bpmOf, tappedBeats } from '#shared/group/beats.ts';
import type { GroupSound } from '#shared/group/group.ts';
import { words } from '../../../i18n/whole.ts';
import { Button, IconButton } from '../../../ui/Button.tsx';
import { ChoiceMenu, type ChoiceMenuProps } from '../../../ui/ChoiceMenu.tsx';
import { Canvas, type Pen } from '../../picture/Canvas.tsx';
import { useDocument, useStores, useView } from '../../stores.ts';
import type { TimeView } from '../timeline/timeline.ts';
import { msAt, xOf } from '../timeline/timeScale.ts';
import { useTimeDrag } from '../timeline/useTimeDrag.ts';
import { instantText } from '../timeline/valueText.ts';
import { changeTempo, removeSound, setBeats, soundMoved, soundOf, type SoundState } from './sound.ts';
import { playerOf } from '../play/player.ts';
import styles from './SoundRow.module.css';

/** `children`: what is drawn over it, as over the tracks. */
export const SoundRow = memo(function SoundRow({ children }: { readonly children: ReactNode }) {
  const stores = useStores();
  const sound = useDocument(({ present }) => present.sound);
  // It follows the group as soon as there is one.
  const { status } = useStore(soundOf(stores).store);
  const [taps, setTaps] = useState(false);
  const [isMenuOpen, setMenuOpen] = useState(false);
  if (sound === undefined) return null;
  return (
    <div className={styles.row} role="group" aria-label={words.sound.row}>
      <Head sound={sound} isOpen={isMenuOpen} onOpen={setMenuOpen} onTap={() => setTaps(true)} />
      <div className={styles.track}>
        <Wave sound={sound} />
        {children}
        {status === 'missing' ? (
          <Missing sound={sound} />
        ) : // A menu that is open keeps the focus to itself, and the button would not get it.
        taps && !isMenuOpen && status === 'ready' ? (
          <TapTempo startMs={sound.startMs} onClose={() => setTaps(false)} />
        ) : (
          <Handle sound={sound} />
        )}
      </div>
    </div>
  );
});

interface SoundMenuProps {
  readonly sound: GroupSound;
  readonly isOpen: boolean;
  onTap(): void;
}

interface HeadProps extends SoundMenuProps {
  onOpen(isOpen: boolean): void;
}

function Head({ onOpen, ...rest }: HeadProps) {
  const { sound, isOpen } = rest;
  const menu = useRef<Element>(null);
  const isMuted = useView((state) => state.sound === 'muted');
  return (
    <div className={styles.head}>
      <span className={styles.name} title={sound.fileName}>
        {sound.fileName}
      </span>
      <span className={styles.tempo}>{isMuted ? words.sound.muted : tempoText(sound)}</span>
      <span className={styles.more}>
        <IconButton
          icon="more"
          label={words.sound.menu}
          aria-haspopup="menu"
          aria-expanded={isOpen}
          onPress={(button) => {
            menu.current = button;
            onOpen(true);
          }}
        />
      </span>
      <SoundMenu {...rest} under={menu} onClose={() => onOpen(false)} />
    </div>
  );
}

const tempoText = ({ beats }: GroupSound): string =>
  beats === null ? words.sound.noBeats : words.sound.tempo({ bpm: Math.round(bpmOf(beats)) });

function SoundMenu({ sound, onTap, ...menu }: SoundMenuProps & Pick<ChoiceMenuProps, 'under' | 'onClose'>) {
  const stores = useStores();
  const { view } = stores;
  const { track } = useStore(soundOf(stores).store);
  const isMuted = useView((state) => state.sound === 'muted');
  const acts: Readonly<Record<string, { readonly name: string; act(): void }>> = {
    ...(track !== null && {
      find: {
        name: words.sound.find,
        act: () =>
          track.beats === null
            ? stores.notices.show('info', words.sound.noneFound)
            : setBeats(stores, track.beats),
      },
      tap: { name: words.sound.tap, act: onTap },
    }),
    ...(sound.beats !== null && {
      half: { name: words.sound.half, act: () => changeTempo(stores, 0.5) },
      double: { name: words.sound.double, act: () => changeTempo(stores, 2) },
      noBeats: { name: words.sound.removeBeats, act: () => setBeats(stores, null) },
    }),
    mute: {
      name: isMuted ? words.sound.unmute : words.sound.mute,
      act: () => view.setState({ sound: isMuted ? 'on' : 'muted' }),
    },
    replace: { name: words.sound.replace, act: () => void soundOf(stores).choose() },
    remove: { name: words.sound.remove, act: () => removeSound(stores) },
  };
  return (
    <ChoiceMenu
      {...menu}
      label={words.sound.menu}
      choices={Object.entries(acts).map(([id, { name }]) => ({ id, name }))}
      onChoose={(id) => acts[id]?.act()}
    />
  );
}

/** On this computer it is nowhere, or not to be decoded. */
function Missing({ sound }: { readonly sound: GroupSound }) {
  const stores = useStores();
  return (
    <div className={styles.missing}>
      <p>{words.sound.missing({ file: sound.fileName })}</p>
      <Button icon="upload" onPress={() => void soundOf(stores).choose()}>
        {words.sound.choose}
      </Button>
    </div>
  );
}

/** All of the row: dragged, it moves the sound. */
function Handle({ sound }: { readonly sound: GroupSound }) {
  const { notices } = useStores();
  const { fileName: file, startMs } = sound;
  const drag = useTimeDrag({
    startMs,
    label: () => words.sound.steps.move,
    moved: soundMoved,
    onStep: (next) => notices.say(words.sound.startsAt({ file, at: instantText(next) })),
  });
  return (
    <div
      {...drag}
      className={styles.handle}
      role="slider"
      tabIndex={0}
      aria-label={words.sound.start}
      aria-valuemin={-MOST_MS}
      aria-valuemax={MOST_MS}
      aria-valuenow={startMs}
      aria-valuetext={words.sound.startsAt({ file, at: instantText(startMs) })}
    />
  );
}

/** What a screen reader takes for the ends. */
const MOST_MS = 3_600_000;

// Beats from taps: the person hears the sound, taps on each beat, and takes what comes of it. Where nothing plays, the sound plays alone.

interface TapTempoProps {
  /** Of the sound, in the group. */
  readonly startMs: number;
  onClose(): void;
}

function TapTempo({ startMs, onClose }: TapTempoProps) {
  const stores = useStores();
  const player = playerOf(stores.playback);
  const [tapsMs, setTaps] = useState<readonly number[]>([]);
  const beats = tappedBeats(tapsMs);
  const button = useRef<HTMLButtonElement>(null);

  // Not sooner: as long as a menu is closing, nothing beside it takes the focus.
  useEffect(() => button.current?.focus(), []);

  useEffect(() => {
    player.listen(true);
    return () => player.listen(false);
  }, [player]);

  function tap(): void {
    const atMs = player.heardAt();
    if (atMs !== null) setTaps((before) => [...before, atMs - startMs]);
  }

  /** At once: a click comes when the key goes up. */
  function key(event: KeyboardEvent): void {
    if (event.key !== ' ' && event.key !== 'Enter') return;
    event.preventDefault();
    if (event.type === 'keydown' && !event.repeat) tap();
  }

  return (
    <div className={styles.taps} role="group" aria-label={words.sound.tap}>
      <button
        type="button"
        ref={button}
        className={styles.tap}
        onPointerDown={(event) => event.button === 0 && tap()}
        onKeyDown={key}
        onKeyUp={key}
      >
        {words.sound.tapHere}
      </button>
      <p className={styles.tapped} role="status">
        {beats === null ? words.sound.tapHint : words.sound.tapped({ bpm: Math.round(bpmOf(beats)) })}
      </p>
      <Button
        isDisabled={beats === null}
        onPress={() => {
          setBeats(stores, beats);
          onClose();
        }}
      >
        {words.sound.take}
      </Button>
      <Button tone="quiet" onPress={onClose}>
        {words.sound.cancel}
      </Button>
    </div>
  );
}

function Wave({ sound }: { readonly sound: GroupSound }) {
  const stores = useStores();
  const { timeline, view } = stores;
  const { store } = soundOf(stores);
  return (
    <Canvas
      className={styles.wave}
      shown={() =>
        [sound, store.getState(), timeline.getState().time, view.getState().sound === 'muted'] as const
      }
      paint={paintWave}
    />
  );
}

/** Above it are the ticks of the beats, the shorter ones where they stand close. */
const BEATS_PX = 8;
const CLOSE_PX = 6;
const INSET_PX = 3;

export function paintWave(
  pen: Pen,
  [sound, { track }, time, isMuted]: readonly [GroupSound, SoundState, TimeView, boolean],
): void {
  const { ctx, look, size } = pen;
  const { startMs, beats } = sound;
  const lengthMs = track?.lengthMs ?? 0;
  const from = Math.max(0, Math.floor(xOf(time, startMs)));
  const to = Math.min(size.width, Math.ceil(xOf(time, startMs + lengthMs)));
  const [top, bottom] = [BEATS_PX + INSET_PX, size.height - INSET_PX];
  const middle = (top + bottom) / 2;
  ctx.fillStyle = look.raised;
  ctx.fillRect(from, BEATS_PX, Math.max(0, to - from), size.height - BEATS_PX);
  if (track === null) return;
  ctx.fillStyle = isMuted ? look.line : look.edge;
  for (let x = from; x < to; x += 1) {
    const first = Math.max(0, Math.floor((msAt(time, x) - startMs) / track.peakMs));
    const last = Math.max(first + 1, Math.ceil((msAt(time, x + 1) - startMs) / track.peakMs));
    let peak = 0;
    for (let at = first; at < last; at += 1) peak = Math.max(peak, track.peaks[at] ?? 0);
    const half = Math.max(0.5, ((bottom - top) / 2) * Math.min(1, peak));
    ctx.fillRect(x, middle - half, 1, 2 * half);
  }
  if (beats === null) return;
  const eachPx = beats.everyMs / time.msPerPx;
  // Closer ones would be one bar: each second, fourth … of them.
  const step = 2 ** Math.max(0, Math.ceil(Math.log2(CLOSE_PX / eachPx)));
  ctx.fillStyle = look['ink-dim'];
  const firstSeen = Math.floor((msAt(time, 0) - startMs - beats.firstMs) / beats.everyMs / step) * step;
  for (let beat = Math.max(0, firstSeen); ; beat += step) {
    const atMs = beats.firstMs + beat * beats.everyMs;
    const x = xOf(time, startMs + atMs);
    if (atMs > lengthMs || x > size.width) break;
    const height = beat % (4 * step) === 0 ? BEATS_PX : BEATS_PX / 2;
    ctx.fillRect(Math.round(x), 0, 1, height);
  }
}
