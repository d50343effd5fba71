// Plays the open group, from the page or on the board, and says where it is: what is played is what compile makes of it, by
// either way. One thing at a time; STOP, a lost link and a hidden page end it. Knows no panel.

import { compileSource } from '../../board/compile/compileSource.ts';
import { problemText } from '../../board/compile/problems.tsx';
import type { StoreApi } from 'zustand/vanilla';
import { blocksOf, endOfBlock } from '#shared/group/blocks.ts';
import { type ActionGroup, holdsMotion, totalDurationMs } from '#shared/group/group.ts';
import { frameEnds } from '#shared/group/tracks.ts';
import type { Activity } from '#shared/robot/state.ts';
import { words } from '../../../i18n/whole.ts';
import { instantText } from '../timeline/valueText.ts';
import { createBoardRun } from './boardRun.ts';
import {
  boardAt,
  boardCourse,
  createPlayedPart,
  pageAt,
  pageCourse,
  spanOf,
  type PagePlay,
  previewAt,
  previewCourse,
  type PreviewPlay,
} from './playedPart.ts';
import { soundOf } from '../sound/sound.ts';
import { type Course, createSoundPlayer, groupAt } from '../sound/soundPlayer.ts';
import { obstacles, type CompiledGroup } from '../../board/compile/compiled.ts';
import { createFollower } from '../../../robot/follower.ts';
import type {
  Overdub,
  PlayedSpan,
  Playback,
  PlaybackOptions,
  PlaybackPhase,
  PlaybackState,
  Player,
} from './playback.ts';
import { endsMotion, startHindrance } from '../../../robot/readiness.ts';
import { servoViewFor } from '../../servoView.ts';

export const SPEED_PERCENT = { min: 10, max: 200 } as const;

const NEAR_END_MS = 100;

export const playerOf = (playback: Playback): Player => playback.player(createPlayer);

/** The ends of frames, and both ends of blocks. */
function stopsOf(group: ActionGroup): readonly number[] {
  const ends = blocksOf(group).flatMap((block) => [block.startMs, endOfBlock(block)]);
  return [0, ...frameEnds(group.frames), ...ends].sort((one, other) => one - other);
}

function createPlayer(options: PlaybackOptions, store: StoreApi<PlaybackState>): Player {
  const { device, document, compiled, slots, notices, view, playhead, robots } = options;
  const { clock } = device;
  const follower = createFollower(device);
  const playedPart = createPlayedPart({
    ...{ device, document, view, playhead, robots },
    chosen: () => store.getState(),
  });
  let following: (PagePlay & { readonly isOverdubbed: boolean }) | null = null;
  let previewing: PreviewPlay | null = null;
  let listening: Course | null = null;
  let span: PlayedSpan | null = null;
  let isPaused = false;

  const { store: soundStore } = soundOf({ document, notices });
  const sound = createSoundPlayer({
    clock,
    createContext: () => new AudioContext({ latencyHint: 'interactive' }),
    playable() {
      const { sound: own } = document.store.getState().present;
      const { track } = soundStore.getState();
      return own === undefined || track === null ? null : { buffer: track.buffer, startMs: own.startMs };
    },
  });
  const setMuted = (): void => sound.setMuted(view.getState().sound === 'muted');
  setMuted();
  view.subscribe(setMuted);

  /** null: nothing moves, or it is not known yet when it will. */
  function course(): Course | null {
    const { latch, waitingToStart } = device.store.getState().snapshot;
    if (latch !== null) return null;
    if (previewing !== null) return previewCourse(previewing, clock.now());
    if (following !== null) {
      const isKnown = following.isUnderWay && !(following.isLead && waitingToStart.length > 0);
      return isKnown ? pageCourse(following) : null;
    }
    const run = store.getState().phase === 'running' ? board.now() : null;
    return run === null ? listening : boardCourse(run, clock.now());
  }

  const playSound = (): void => sound.follow(course());

  function followPlayhead(): void {
    if (document.store.getState().present.unit === device.store.getState().family.unit)
      follower.follow(playedPart.poseAt(playhead.at()));
  }

  const activity = (): Activity => device.store.getState().snapshot.activity;
  const phase = (next: PlaybackPhase | null): void => {
    if (store.getState().phase !== next) store.setState({ phase: next });
  };

  /** What may be played now; else null, and a notice says why. */
  function playable(by: 'page' | 'board'): CompiledGroup | null {
    const hindrance = startHindrance(device.store.getState().snapshot);
    const group = compiled.now(compileSource);
    const [problem] = obstacles(group.report, by);
    const reason =
      hindrance !== null
        ? words.servos.blocked[hindrance]
        : group.frames.length === 0
          ? words.board.nothingToDownload
          : problem === undefined
            ? null
            : problemText(problem, group.source);
    if (reason === null) return group;
    notices.show('warning', reason);
    return null;
  }

  function play(overdub?: Overdub): void {
    const group = playable('page');
    if (group === null) return;
    store.setState({ isLive: false });
    const passage = playedPart.passage(group, overdub?.servos);
    const times = overdub === undefined ? playedPart.passes() : 1;
    const { speedPercent } = store.getState();
    const playedId = options.documentId();
    following = {
      ...{ passage, index: 0, beganMs: clock.now(), isLead: true, isUnderWay: false },
      ...{ speedPercent, passesLeft: times, isOverdubbed: overdub !== undefined },
    };
    [span, isPaused] = [null, false];
    if (overdub !== undefined) showOverdubbed(overdub.servos);
    phase('leading');
    sound.wake();
    playhead.show(passage.atMs[0] ?? 0);
    const ended = (isDone: boolean): void => {
      if (isDone) playhead.go(passage.atMs.at(-1) ?? 0);
      following = null;
      phase(null);
      playSound();
      if (overdub === undefined) return;
      showOverdubbed([]);
      const isUsable = (isDone || isPaused) && options.documentId() === playedId;
      overdub.ended(span !== null && isUsable ? { ...span, toMs: playhead.at() } : null);
    };
    device.play(passage.frames, times, ended, passage.loopFrom);
  }

  function showOverdubbed(overdubbed: readonly number[]): void {
    const { id } = robots.current();
    view.setState({ servos: { ...servoViewFor(view.getState().servos, id), robotId: id, overdubbed } });
  }

  function preview(): void {
    if (!holdsMotion(document.store.getState().present)) {
      notices.show('warning', words.board.nothingToDownload);
      return;
    }
    store.setState({ isLive: false });
    const { speedPercent } = store.getState();
    const part = playedPart.part();
    const startMs = playedPart.within() ?? part.fromMs;
    previewing = { ...part, startMs, passes: playedPart.passes(), speedPercent, beganMs: clock.now() };
    phase('previewing');
    playhead.show(startMs);
    sound.wake();
    playSound();
  }

  function endPreview(): void {
    if (previewing === null) return;
    previewing = null;
    phase(null);
    playSound();
  }

  const board = createBoardRun({
    ...{ device, compiled, slots, place: options.place, replacing: options.replacing, view },
    documentId: () => options.documentId(),
    phase(next) {
      phase(next);
      if (next === 'running') playhead.show(0);
    },
  });

  function runOnBoard(): void {
    const group = playable('board');
    const { times, untilStopped } = view.getState();
    const isEndless = untilStopped || store.getState().loops;
    if (group === null) return;
    sound.wake();
    board.begin(group, isEndless ? 0 : times);
  }

  function pause(): void {
    if (previewing !== null) endPreview();
    else if (following !== null) {
      isPaused = true;
      device.stopPlaying();
    } else if (activity().kind === 'downloading') slots.cancel();
    else if (activity().kind === 'running') device.stopGroup();
  }

  let last = activity();
  device.store.subscribe(({ snapshot }, { snapshot: before }) => {
    const next = snapshot.activity;
    // The servos of the first pose start one after another: the way there begins with the last of them.
    if (following?.isLead === true && snapshot.waitingToStart.length < before.waitingToStart.length)
      following = { ...following, beganMs: clock.now() };
    if (next !== last) {
      last = next;
      noteActivity(next);
      playSound();
    }
    if (snapshot.latch !== null && before.latch === null) {
      endPreview();
      listening = null;
      playSound();
    }
    if (endsMotion(snapshot)) store.setState({ isLive: false });
  });

  function noteActivity(next: Activity): void {
    if (next.kind === 'playing' && following !== null) {
      const isLead = following.isLead && next.frameIndex === 0;
      const isAgain = !isLead && next.frameIndex <= following.index;
      const passesLeft = following.passesLeft - (isAgain && following.passesLeft > 0 ? 1 : 0);
      const began = { index: next.frameIndex, beganMs: clock.now(), isUnderWay: true };
      following = { ...following, ...began, isLead, passesLeft };
      const isBack = following.passage.returns && next.frameIndex === 0;
      if (!isLead) span ??= spanOf(following);
      phase(isLead ? 'leading' : isBack ? 'returning' : following.isOverdubbed ? 'recording' : 'playing');
    }
    if (next.kind !== 'idle' || store.getState().phase !== 'running') return;
    phase(null);
    // The board's word comes between two drawings.
    const lengthMs = totalDurationMs(compiled.store.getState().latest.frames);
    if (lengthMs - playhead.at() < NEAR_END_MS) playhead.go(lengthMs);
  }

  function showPreview(play: PreviewPlay): void {
    const atMs = previewAt(play, clock.now());
    playhead.go(Math.round(atMs ?? play.toMs));
    if (atMs === null) endPreview();
  }

  function showBoard(): void {
    const run = board.now();
    if (run !== null) playhead.go(Math.round(boardAt(run, clock.now())));
  }

  function step(direction: 1 | -1): void {
    const stops = stopsOf(document.store.getState().present);
    const at = playhead.at();
    const to =
      direction === 1 ? stops.find((stopMs) => stopMs > at) : stops.findLast((stopMs) => stopMs < at);
    if (to !== undefined) {
      if (store.getState().isLive)
        follower.go(playedPart.poseAt(to), Math.abs(to - at), playedPart.poseAt(at));
      playhead.show(to);
    }
    notices.say(instantText(playhead.at()));
  }

  return {
    next: () => ({ fromMs: playedPart.within(), times: playedPart.passes() }),
    set(change) {
      if (change.isLive === true) follower.begin();
      store.setState(change);
    },
    play,
    toggle: () => (store.getState().phase === null ? play() : pause()),
    togglePreview: () => (store.getState().phase === null ? preview() : pause()),
    runOnBoard,
    pause,
    step,
    frame() {
      if (previewing !== null) showPreview(previewing);
      else if (following !== null) playhead.go(Math.round(pageAt(following, clock.now())));
      else showBoard();
      if (store.getState().isLive) followPlayhead();
      playSound();
    },
    listen(isOn) {
      const { sound: own } = document.store.getState().present;
      const { track } = soundStore.getState();
      const canHear = isOn && own !== undefined && track !== null;
      listening = canHear
        ? {
            ...{ atMs: own.startMs, sinceMs: clock.now(), rate: 1 },
            ...{ untilMs: own.startMs + track.lengthMs, thenMs: null },
          }
        : null;
      if (isOn) sound.wake();
      playSound();
    },
    heardAt() {
      const now = course();
      return now === null ? null : groupAt(now, clock.now());
    },
    hidden() {
      listening = null;
      endPreview();
      store.setState({ isLive: false });
      device.stopPlaying();
    },
  };
}
