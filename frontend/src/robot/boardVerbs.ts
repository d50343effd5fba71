// Requests to the board and its link besides motion by hand: STOP, groups, readings, memory. Whatever fails becomes a
// notice. Knows no panel.

import type { Frame } from '#shared/codec/commands.ts';
import type { Family } from '#shared/codec/families.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import type { Robot } from '#shared/robot/robot.ts';
import type { HaltReason, SlotGroup } from '#shared/robot/state.ts';
import { downloadedSentence, downloadCancelled, linkSentence } from '../i18n/sentences.ts';
import { words } from '../i18n/words.ts';
import type { Notices } from '../state/notices.ts';
import type { LimitGate } from './moves.ts';
import type { Clock } from '#shared/clock.ts';

export interface BoardVerbs {
  halt(why?: HaltReason): void;
  resume(): void;
  identify(): void;
  choose(family: Family): void;
  /** `settled` hears whether the board took it, as far as can be known. */
  run(slot: number, times: number, settled?: Settled): void;
  stopGroup(): void;
  /** `settled` hears whether the board said so. */
  erase(settled?: Settled): void;
  readBattery(): void;
  /** Not requested by a person, so its failure gives no notice: another screen's question may have met this one on the board (S52). */
  watchBattery(): void;
  readPositions(servos: readonly number[], settled?: Settled): void;
  /** Firmware and trims, one question after the other. */
  readDetails(): void;
  setSpeed(slot: number | null, percent: number): void;
  release(servos: readonly number[], settled?: Settled): void;
  sendRaw(packet: Uint8Array): void;
  /** One after the other. `settled` hears whether all of them are stored. */
  download(groups: readonly SlotGroup[], settled?: Settled): void;
  cancelDownload(): void;
  /** `times` 0: until stopped; each pass but the first begins with frame `loopFrom`. `settled` hears whether the last frame was played: not after a pause, a stop or a failure. */
  play(frames: readonly Frame[], times: number, settled: Settled, loopFrom?: number): void;
  stopPlaying(): void;
}

export type Settled = (isDone: boolean) => void;

export interface BoardVerbsOptions {
  /** null while nothing is connected. */
  session(): Robot | null;
  readonly gate: LimitGate;
  readonly notices: Notices;
  readonly lateNotices: LateNotices;
  showError(error: unknown): void;
}

export function createBoardVerbs({
  session: now,
  gate,
  notices,
  lateNotices,
  showError,
}: BoardVerbsOptions): BoardVerbs {
  function attempt(
    work: (session: Robot) => Promise<unknown>,
    settled: Settled = () => undefined,
    failed: (error: unknown, session: Robot) => void = showError,
  ): void {
    const session = now();
    if (session === null) return settled(false);
    work(session).then(
      (isDone) => {
        lateNotices.requested();
        settled(isDone !== false);
      },
      (error: unknown) => {
        failed(error, session);
        settled(false);
      },
    );
  }

  /** As `attempt`; what the battery's alarm refuses may be begun once anyway. */
  function attemptRun(work: (session: Robot, anyway: boolean) => Promise<unknown>, settled?: Settled): void {
    attempt(
      (current) => work(current, false),
      settled,
      (error, refusing) => {
        if (!(error instanceof LinkError && error.code === 'batteryLow')) return showError(error);
        notices.ofBoard.show('warning', words.battery.runRefused({ volts: volts(refusing) }), {
          label: words.battery.anyway,
          act() {
            if (now() === refusing) attempt((current) => work(current, true));
          },
        });
      },
    );
  }

  /** False where it was called off. */
  async function downloadTo(current: Robot, groups: readonly SlotGroup[]): Promise<boolean> {
    const slots = groups.map(({ slot }) => slot);
    try {
      await current.download(groups);
      notices.ofBoard.show('info', downloadedSentence(slots));
      return true;
    } catch (error) {
      if (!(error instanceof LinkError && error.code === 'cancelled')) throw error;
      const broken = slots.find((slot) => current.state.brokenSlots.includes(slot));
      notices.ofBoard.show('warning', downloadCancelled(broken ?? null));
      return false;
    }
  }

  return {
    halt: (why) => attempt((current) => current.halt(why)),
    resume: () => attempt((current) => current.resume()),
    identify: () => attempt((current) => current.identify()),
    choose: (chosen) => attempt((current) => current.choose(chosen)),
    run: (slot, times, settled) =>
      attemptRun((current, anyway) => current.run(slot, times, { anyway }), settled),
    stopGroup: () => attempt((current) => current.stopGroup()),
    erase: (settled) =>
      attempt(
        (current) => current.erase().then(() => notices.ofBoard.show('info', words.board.erased)),
        settled,
      ),
    readBattery: () => attempt((current) => current.readBattery()),
    watchBattery: () =>
      void now()
        ?.readBattery()
        .catch(() => undefined),
    readPositions: (servos, settled) => attempt((current) => current.readPositions(servos), settled),
    readDetails: () => attempt((current) => current.readVersion().then(() => current.readOffsets())),
    setSpeed: (slot, percent) =>
      attempt((current) =>
        current.setSpeed(slot, percent).then(() => notices.ofBoard.show('info', speedSent(slot, percent))),
      ),
    release: (servos, settled) => attempt((current) => current.release(servos), settled),
    download(groups, settled = () => undefined) {
      const onIt = gate.groups(groups);
      if (onIt === null) settled(false);
      else attempt((current) => downloadTo(current, onIt), settled);
    },
    sendRaw(packet) {
      if (gate.lets(packet)) attempt((current) => current.sendRaw(packet));
    },
    cancelDownload: () => attempt((current) => current.cancelDownload()),
    play(frames, times, settled, loopFrom = 0) {
      const onIt = gate.frames(frames);
      if (onIt === null) {
        settled(false);
        return;
      }
      attemptRun(async (current, anyway) => {
        const { lateFrames, latestMs, skippedFrames, isWhole } = await current.play(onIt, {
          times,
          loopFrom,
          anyway,
        });
        if (skippedFrames > 0) notices.ofBoard.show('warning', words.play.skipped({ frames: skippedFrames }));
        else if (lateFrames > 0)
          notices.ofBoard.show('info', words.play.late({ frames: lateFrames, ms: latestMs }));
        return isWhole;
      }, settled);
    },
    stopPlaying: () => now()?.stopPlaying(),
  };
}

const volts = ({ state: { battery } }: Robot): string =>
  words.numbers.formatVolts(battery.kind === 'read' ? battery.batteryMv : 0);

function speedSent(slot: number | null, percent: number): string {
  return slot === null ? words.board.speedSentToAll({ percent }) : words.board.speedSent({ slot, percent });
}

interface LateNotices {
  report(error: unknown): void;
  /** Something was requested and not refused. */
  requested(): void;
}

const LATE: readonly LinkErrorCode[] = ['expired', 'overslept'];
/** Long enough to be read, and to hear of another refusal. */
const WELL_MS = 3000;

/** A notice that something came too late, or was slept through, stays shown until the same goes well. */
export function createLateNotices(clock: Clock, notices: Pick<Notices, 'takeBack'>): LateNotices {
  let texts: readonly string[] = [];
  let cancel: (() => void) | null = null;

  function wait(): void {
    cancel?.();
    cancel = null;
  }

  return {
    report(error) {
      if (!(error instanceof LinkError) || !LATE.includes(error.code)) return;
      wait();
      texts = [...texts, linkSentence(error)];
    },
    requested() {
      if (texts.length === 0 || cancel !== null) return;
      cancel = clock.after(WELL_MS, () => {
        for (const text of texts) notices.takeBack(text);
        texts = [];
        cancel = null;
      });
    },
  };
}
