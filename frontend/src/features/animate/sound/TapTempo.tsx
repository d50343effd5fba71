// Beats from taps, on the row of the sound: the person hears it, taps on each beat, and takes what comes of it. Where nothing plays, the sound
// plays alone.

import { type KeyboardEvent, useEffect, useRef, useState } from 'react';
import { bpmOf, tappedBeats } from '#shared/group/beats.ts';
import { words } from '../../../i18n/whole.ts';
import { Button } from '../../../ui/Button.tsx';
import { playerOf } from '../play/player.ts';
import { useStores } from '../../stores.ts';
import { setBeats } from './sound.ts';
import styles from './SoundRow.module.css';

interface TapTempoProps {
  /** Of the sound, in the group. */
  readonly startMs: number;
  onClose(): void;
}

export function TapTempo({ startMs, onClose }: TapTempoProps) {
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
