// Playing the group: from the page, from where the playhead is, or by the board itself, which gets it first where it has not just
// this. The current activity is shown in a line that is always there.

import { useShallow } from 'zustand/react/shallow';
import type { SlotContent } from '#shared/group/slotBook.ts';
import type { Player, PlaybackPhase } from './playback.ts';
import { canRunOnBoard, PLAY, PREVIEW, RUN_ON_BOARD, STEP_BACK, STEP_FORTH } from './playActions.ts';
import { playerOf, SPEED_PERCENT } from './player.ts';
import {
  useStores,
  useDevice,
  useDocument,
  useHoldsMotion,
  usePlayback,
  useRobot,
  useServoView,
  useSlot,
  useSnapshot,
  useView,
} from '../../stores.ts';
import { chosenTimes } from '../../board/slots/groupPlace.ts';
import { useSlotContents } from '../../board/slots/slotHooks.ts';
import { motionHindrance, startHindrance } from '../../../robot/readiness.ts';
import { isSilent } from '../../servoView.ts';
import { CollisionNote } from '../../board/compile/problems.tsx';
import { holdsMotion } from '#shared/group/group.ts';
import { timesOf } from '#shared/group/groupTimes.ts';
import { ActionButton, ActionIconButton, Button } from '../../../ui/Button.tsx';
import { cx } from '../../../ui/cx.ts';
import { LiveText } from '../../../ui/LiveText.tsx';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { Toggle } from '../../../ui/Toggle.tsx';
import { words } from '../../../i18n/whole.ts';
import styles from './PlayBar.module.css';

// What plays the open group; it is there from the first panel on that has buttons for it.

const usePlayer = (): Player => playerOf(useStores().playback);

export function PlayBar() {
  const phase = usePlayback((state) => state.phase);
  const stores = useStores();
  useHoldsMotion();
  const isIdle = phase === null;
  return (
    <div className={styles.bar} role="group" aria-label={words.play.tools}>
      <ActionIconButton action={STEP_BACK} shown={stores} context={() => stores} />
      <PlayButton phase={phase} />
      <ActionIconButton action={STEP_FORTH} shown={stores} context={() => stores} />
      <PreviewButton phase={phase} />
      <RunOnBoard />
      <div className={cx(styles.side, !isIdle && styles.busy)}>
        <Settings isDisabled={!isIdle} />
        <Phase phase={phase} />
      </div>
    </div>
  );
}

/** The stores, read again with each change of what decides whether something of the group can be sent. */
function useSendable() {
  useDocument(({ present }) => `${present.unit} ${holdsMotion(present)}`);
  useSnapshot(startHindrance);
  useDevice((state) => state.family);
  return useStores();
}

/** One button to begin and to end: the focus is still on it when what it began is to end. */
function PlayButton({ phase }: { readonly phase: PlaybackPhase | null }) {
  const player = usePlayer();
  const may = PLAY.enabled(useSendable());
  const whyNot = may === true ? undefined : may;
  const ends = phase === null || phase === 'previewing' ? null : phase;
  return (
    <Button
      icon={ends === null ? PLAY.icon : END_ICONS[ends]}
      keys={PLAY.keys}
      whyNot={ends === null ? whyNot : undefined}
      isDisabled={ends === null && (whyNot !== undefined || phase !== null)}
      onPress={() => (ends === null ? player.play() : player.pause())}
    >
      <PlayWords ends={ends} />
    </Button>
  );
}

const END_ICONS = {
  leading: 'pause',
  returning: 'pause',
  playing: 'pause',
  recording: 'end',
  storing: 'end',
  running: 'end',
} as const;

function endWord(phase: keyof typeof END_ICONS): string {
  if (phase === 'storing') return words.play.cancel;
  return phase === 'running' || phase === 'recording' ? words.play.end : words.play.pause;
}

/** As the one to play. */
function PreviewButton({ phase }: { readonly phase: PlaybackPhase | null }) {
  const stores = useStores();
  const isEmpty = !useHoldsMotion();
  const isOn = phase === 'previewing';
  const may = PREVIEW.enabled(stores);
  return (
    <Button
      icon={isOn ? 'pause' : PREVIEW.icon}
      hint={words.play.previewHint}
      keys={PREVIEW.keys}
      whyNot={may === true ? undefined : may}
      isDisabled={isEmpty || (phase !== null && !isOn)}
      onPress={() => PREVIEW.run(stores)}
    >
      <span className={cx(styles.words, styles.preview)} data-longest={words.play.preview}>
        <span className={styles.now}>{isOn ? words.play.pause : words.play.preview}</span>
      </span>
    </Button>
  );
}

/** A button need not change faster than it can be read. */
const SAID_EACH_MS = 500;

/** From where, as the playhead goes, or how often; or what ends it. With room for the longest: what follows stays in its place. */
function PlayWords({ ends }: { readonly ends: keyof typeof END_ICONS | null }) {
  const player = usePlayer();
  const loops = usePlayback((state) => state.loops);
  const times = useView(chosenTimes);
  const fromEnd = words.play.playFrom({ atMs: useDocument(({ present }) => timesOf(present).lengthMs) });
  const whole = words.play.play({ times: loops ? 1 : times });
  return (
    <span className={styles.words} data-longest={whole.length > fromEnd.length ? whole : fromEnd}>
      <LiveText
        isFixed
        className={styles.now}
        eachMs={SAID_EACH_MS}
        text={() => {
          if (ends !== null) return endWord(ends);
          const { fromMs, times: passes } = player.next();
          return fromMs === null
            ? words.play.play({ times: loops ? 1 : passes })
            : words.play.playFrom({ atMs: fromMs });
        }}
      />
    </span>
  );
}

function Settings({ isDisabled }: { readonly isDisabled: boolean }) {
  const player = usePlayer();
  const { speedPercent, loops, isLive } = usePlayback((state) => state);
  const mayMove = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const { min, max } = SPEED_PERCENT;
  return (
    <div className={styles.settings}>
      <Toggle
        label={words.play.loop}
        isOn={loops}
        isDisabled={isDisabled}
        onChange={(isOn) => player.set({ loops: isOn })}
      />
      <CheckedNumber
        label={words.play.speedField}
        value={speedPercent}
        min={min}
        max={max}
        step={10}
        unit={words.play.percent}
        size="small"
        isDisabled={isDisabled}
        onChange={(percent) => player.set({ speedPercent: percent })}
      />
      <Toggle
        label={words.play.live}
        isOn={isLive}
        isDisabled={isDisabled || !mayMove}
        onChange={(isOn) => player.set({ isLive: isOn })}
      />
    </div>
  );
}

function RunOnBoard() {
  const stores = useSendable();
  usePlayback((state) => state.phase);
  const slot = useSlot();
  const content = useSlotContents()(slot);
  if (!canRunOnBoard(stores)) return null;
  return (
    <ActionButton
      action={RUN_ON_BOARD}
      shown={stores}
      context={() => stores}
      hint={boardHint(slot, content)}
    />
  );
}

/** Whether it downloads first is said before. */
function boardHint(slot: number, content: SlotContent): string {
  return content === 'same'
    ? words.play.onBoardHint({ slot })
    : words.play.onBoardDownloads({ slot, isOlder: content === 'older' });
}

function Phase({ phase }: { readonly phase: PlaybackPhase | null }) {
  const speedPercent = usePlayback((state) => state.speedPercent);
  const silent = useSilentRows();
  const { playing, ...others } = words.play.phase;
  const rests = silent.length === 0 ? '' : words.play.silent({ names: words.numbers.formatNames(silent) });
  return (
    <p className={styles.phase} role="status">
      {phase === null && <CollisionNote />}
      {phase === null ? rests : phase === 'playing' ? playing({ share: speedPercent / 100 }) : others[phase]}
    </p>
  );
}

/** The servos of the group that are muted, or beside those that play alone, by name. */
function useSilentRows(): readonly string[] {
  const { servos } = useRobot();
  // Not all of the view: a servo that is dragged changes it in each frame.
  const muted = useServoView((view) => view.muted);
  const solo = useServoView((view) => view.solo);
  return useDocument(
    useShallow(({ present }) => {
      const { tracks } = timesOf(present);
      return servos
        .filter(({ servo }) => tracks.has(servo) && isSilent({ muted, solo }, servo))
        .map(({ name }) => name);
    }),
  );
}
