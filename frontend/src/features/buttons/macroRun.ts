// Does what a button says, step by step, by the ordinary roads: poses through the device and its limits, slots by the
// board's own run. One button at a time; what stops the robot or loses it ends the button for good. Knows no panel.

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
import { limitRefusal } from '../../robot/limitGate.ts';
import { GENTLE_MOVE_MS } from '../../robot/moveTime.ts';
import type { Poses } from '../poses/poses.ts';
import { endsMotion, startHindrance } from '../../robot/readiness.ts';

// The page of buttons of the robot at hand. Never moves anything; macroRun.ts does what a button says.

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
  /** null: no button is at work. */
  readonly store: StoreApi<MacroProgress | null>;
  /** Begins nothing while another button is at work, and nothing that a limit would end halfway. */
  start(macro: Macro): void;
  /** Goes no further. A move in progress ends by itself, as with every move but STOP. */
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
  /** Tells a late word about an earlier button from one about this. */
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

  /** First moves are slow, whatever was asked for, and begin one after another (safety.md section 2). */
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

  /** What would keep the button from its end, as a sentence; null where nothing is known. */
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
      else notices.tell('warning', reason);
    },
    end() {
      if (store.getState() === null) return;
      if (isRunning()) device.stopGroup();
      finish();
    },
  };
}
