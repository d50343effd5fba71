// The buttons of the current robot, and running one step by step: poses move within the robot's limits, slots run on the board. One
// button runs at a time; a stop or a lost link ends it. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import {
  EMPTY_PAGE,
  type MacroPage,
  macroPageFromText,
  macroPageToText,
  type Macro,
  type MacroStep,
} from '#shared/profile/macro.ts';
import type { Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { startsKnown } from '#shared/robot/state.ts';
import { FIRST_MOVE_STAGGER_MS } from '#shared/robot/timings.ts';
import { flawSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { TextStorage } from '../../state/storage.ts';
import type { Notices } from '../../state/notices.ts';
import { createRobotDocument, type RobotDocument } from '../profiles/robotDocument.ts';
import type { RobotStore } from '../profiles/robots.ts';
import type { Device } from '../../robot/device.ts';
import { GENTLE_MOVE_MS, limitRefusal } from '../../robot/moves.ts';
import type { Poses } from '../poses/poses.ts';
import { endsMotion, startHindrance } from '../../robot/readiness.ts';

/** The document with the buttons of the current robot. */
export function createMacros(
  storage: TextStorage,
  notices: Notices,
  robots: RobotStore,
): RobotDocument<MacroPage> {
  return createRobotDocument({
    ...{ storage, notices, robots, key: 'servodeck.buttons' },
    ...{
      notSaved: () => words.macros.notSaved,
      unreadable: (flaw) => words.macros.unreadable({ flaw: flawSentence(flaw) }),
    },
    ...{ fresh: () => EMPTY_PAGE, toText: macroPageToText, fromText: macroPageFromText },
  });
}

export interface MacroProgress {
  readonly macroId: number;
  readonly stepIndex: number;
  readonly stepCount: number;
}

export interface MacroRun {
  /** null: no button is running. */
  readonly store: StoreApi<MacroProgress | null>;
  /** Does nothing while another button runs, or if a limit would end this one halfway. */
  start(macro: Macro): void;
  /** Starts no further step. A move in progress completes; only STOP ends it. */
  end(): void;
}

interface MacroRunOptions {
  readonly device: Device;
  readonly poses: Poses;
  readonly robots: RobotStore;
  readonly notices: Notices;
  readonly clock: Clock;
}

export function createMacroRun({ device, poses, robots, notices, clock }: MacroRunOptions): MacroRun {
  const store = createStore<MacroProgress | null>(() => null);
  let stopWaiting = (): void => undefined;
  /** Distinguishes late answers for an earlier button from those for this one. */
  let round = 0;

  function finish(): void {
    round += 1;
    stopWaiting();
    stopWaiting = () => undefined;
    store.setState(null, true);
  }

  function begin(macro: Macro, stepIndex: number): void {
    const step = macro.steps[stepIndex];
    if (step === undefined) return finish();
    store.setState({ macroId: macro.id, stepIndex, stepCount: macro.steps.length }, true);
    const mine = round;
    take(step, () => {
      if (mine === round) begin(macro, stepIndex + 1);
    });
  }

  function take(step: MacroStep, next: () => void): void {
    if (step.kind === 'wait') stopWaiting = clock.after(step.waitMs, next);
    else if (step.kind === 'slot') runSlot(step.slot, step.times, next);
    else {
      const durationMs = reachedAfterMs(poses.targetsOf(step.pose) ?? [], step.durationMs);
      if (poses.apply(step.pose, step.durationMs)) stopWaiting = clock.after(durationMs, next);
      else finish();
    }
  }

  /** First moves are slow, whatever duration was requested, and start one after another (safety.md section 2). */
  function reachedAfterMs(targets: readonly ServoTarget[], durationMs: number): number {
    const unknown = targets.map(({ servo }) => servo).filter((servo) => !startsKnown(device.motion(servo)));
    const starting = new Set([...device.store.getState().snapshot.waitingToStart, ...unknown]);
    if (unknown.length === 0) return durationMs;
    return Math.max(durationMs, GENTLE_MOVE_MS) + (starting.size - 1) * FIRST_MOVE_STAGGER_MS;
  }

  function runSlot(slot: number, times: number, next: () => void): void {
    const mine = round;
    device.run(slot, times, (isTaken) => {
      if (mine !== round) return;
      if (isTaken) whenRunEnds(next);
      else finish();
    });
  }

  const isRunning = (): boolean => device.store.getState().snapshot.activity.kind === 'running';

  function whenRunEnds(next: () => void): void {
    if (!isRunning()) return next();
    stopWaiting = device.store.subscribe(() => {
      if (isRunning()) return;
      stopWaiting();
      next();
    });
  }

  /** Why the button could not run to its end, as a sentence; null if it can. */
  function obstacle({ steps }: Macro): string | null {
    const hindrance = startHindrance(device.store.getState().snapshot);
    if (hindrance !== null) return words.servos.blocked[hindrance];
    if (steps.length === 0) return words.macros.empty;
    for (const step of steps) {
      if (step.kind !== 'pose') continue;
      const targets = poses.targetsOf(step.pose);
      if (targets === null) return words.poses.gone;
      const refusal = limitRefusal(robots.current().robot, targets);
      if (refusal !== null) return refusal;
    }
    return null;
  }

  device.store.subscribe(({ snapshot }) => {
    if (store.getState() !== null && endsMotion(snapshot)) finish();
  });
  robots.store.subscribe((state, before) => {
    if (state.present.currentId !== before.present.currentId && store.getState() !== null) finish();
  });

  return {
    store,
    start(macro) {
      if (store.getState() !== null) return;
      const reason = obstacle(macro);
      if (reason === null) begin(macro, 0);
      else notices.show('warning', reason);
    },
    end() {
      if (store.getState() === null) return;
      if (isRunning()) device.stopGroup();
      finish();
    },
  };
}
