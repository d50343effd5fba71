// Driving by pad and keys: reads them once a frame and sends what the robot's mapping makes of them. Off until a person switches
// it on, and off again with STOP, the link, the pad or the robot gone. What turns inputs into moves comes with the panel that has the
// switch: the first load needs none of it. Knows no panel and no browser event.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import {
  type Input,
  type Mapping,
  isPressed,
  movedInput,
  NO_INPUTS,
  type Inputs,
  readyMapping,
  mappingFromText,
  mappingToText,
} from '#shared/profile/mapping.ts';
import type { Begun, DriveState, step } from '#shared/profile/mappingStep.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { servoLabel, stayingSentence, flawSentence } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import { isLocked } from '../servoView.ts';
import type { View } from '../view.ts';
import type { Device } from '../../robot/device.ts';
import type { Notices } from '../../state/notices.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import type { Poses } from '../poses/poses.ts';
import type { RobotStore } from '../profiles/robots.ts';
import type { Undoable } from '../../state/undoable.ts';
import type { TextStorage } from '../../state/storage.ts';
import { createRobotDocument, type RobotDocument } from '../profiles/robotDocument.ts';

/** What is needed of a pad of the browser. */
export interface Gamepadlike {
  readonly id: string;
  readonly index: number;
  readonly mapping: string;
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly value: number }[];
}

export interface PadState {
  readonly isDriving: boolean;
  /** null: none is there, or none was touched yet; browsers hide it until then. */
  readonly pad: { readonly name: string; readonly isStandard: boolean } | null;
}

export interface Pad {
  readonly store: StoreApi<PadState>;
  /** As they were at the last frame, for pictures. */
  inputs(): Inputs;
  /** To be called once a frame, while the page is drawn. */
  frame(): void;
  /** By what turns inputs into moves; null: not any more. */
  drive(by: typeof step | null): void;
  /** True where the key is meant for this, and nobody else should hear of it. */
  keyDown(code: string, isRepeat: boolean): boolean;
  /** Letting go of any key lets go of all: a key-up that never came cannot leave one stuck. */
  keyUp(): void;
  /** Nobody looks, or the keys go elsewhere: everything rests until the page is looked at again. */
  leave(): void;
  comeBack(): void;
  /** The next input that is moved is told instead of being obeyed. Returns how to give up waiting. */
  listen(heard: (input: Input) => void): () => void;
}

interface PadOptions {
  readonly device: Device;
  readonly robots: RobotStore;
  readonly view: View;
  readonly poses: Pick<Poses, 'apply'>;
  readonly mappings: Pick<Undoable<Mapping>, 'store'>;
  readonly notices: Notices;
  readonly clock: Clock;
  /** The browser's pads; may throw where a page must not see them. */
  readPads(): readonly (Gamepadlike | null)[];
}

/** A frame that came late must not make up for it in one leap. */
const LONGEST_STEP_MS = 100;
/** Stopping, walking through the page and changing what other keys mean. */
const RESERVED_KEY = /^(Escape|Tab|CapsLock|(Shift|Control|Alt|Meta)(Left|Right))$/;

export function createPad(options: PadOptions): Pad {
  const { device, robots, view, poses, mappings, notices, clock, readPads } = options;
  const store = createStore<PadState>(() => ({ isDriving: false, pad: null }));
  const keys = new Set<string>();
  let inputs = NO_INPUTS;
  let takeStep: typeof step | null = null;
  let driven: DriveState | undefined;
  let lastMs = clock.now();
  let isAway = false;
  /** Servos that were meant and stayed, of which the person was told. */
  let staying: readonly number[] = [];
  /** Servos whose range was told since driving began: a gripper is at its limits all the time. */
  let limited: readonly number[] = [];
  let stopWasPressed = false;
  let seenPad: string | null = null;
  let listener: { readonly before: Inputs; heard(input: Input): void } | null = null;

  const hindrance = () => motionHindrance(device.store.getState().snapshot);
  const mapping = () => mappings.store.getState().present;

  function rest(): void {
    driven = undefined;
    staying = [];
    keys.clear();
  }

  function drive(by: typeof step | null): void {
    rest();
    const wasDriving = store.getState().isDriving;
    const isAllowed = by !== null && hindrance() === null;
    takeStep = by;
    if (isAllowed === wasDriving) return;
    limited = [];
    store.setState({ isDriving: isAllowed });
  }

  function findPad(): Gamepadlike | null {
    try {
      return readPads().find((pad) => pad !== null) ?? null;
    } catch {
      return null;
    }
  }

  function readInputs(): void {
    const pad = findPad();
    const name = pad && `${pad.index} ${pad.id}`;
    if (name !== seenPad) notePad(pad, name);
    inputs = {
      axes: pad?.axes ?? [],
      buttons: pad?.buttons.map(({ value }) => value) ?? [],
      keys: new Set(keys),
    };
  }

  function notePad(pad: Gamepadlike | null, name: string | null): void {
    const isGone = seenPad !== null;
    seenPad = name;
    store.setState({
      pad: pad && { name: pad.id.replace(/ *\(.*/, ''), isStandard: pad.mapping === 'standard' },
    });
    rest();
    if (isGone && store.getState().isDriving) {
      drive(null);
      notices.tell('warning', words.pad.gone);
    }
  }

  function tellListener(input: Input): void {
    const heard = listener?.heard;
    listener = null;
    // The finger is still there; only its next press means what was bound.
    stopWasPressed = true;
    rest();
    heard?.(input);
  }

  /** Stop needs no switch: whoever has a pad in hand may stop. */
  function obeyStop(): void {
    const stops = mapping().bindings.filter(({ action }) => action.kind === 'stop');
    const isStopPressed = stops.some(({ input }) => isPressed(input, inputs));
    if (isStopPressed && !stopWasPressed) {
      drive(null);
      device.halt();
    }
    stopWasPressed = isStopPressed;
  }

  function begin(action: Begun): void {
    if (action.kind === 'run') device.run(action.slot, 1);
    else poses.apply(action.pose, action.durationMs);
  }

  function obey(dtMs: number): void {
    if (takeStep === null) return;
    const { robot } = robots.current();
    const driving = {
      ...{ mapping: mapping(), robot, place: device.motions() },
      isLocked: (servo: number) => isLocked({ view, robots }, servo),
    };
    const moment = takeStep(driving, inputs, dtMs, driven);
    driven = moment.state;
    if (moment.moves.length > 0) device.move(moment.moves, 'hand');
    moment.begun.forEach(begin);
    const among = (servos: readonly number[], wanted: readonly number[]): readonly RobotServo[] =>
      robot.servos.filter(({ servo }) => servos.includes(servo) && !wanted.includes(servo));
    for (const servo of among(moment.unknown, staying))
      notices.tell('warning', words.pad.unknown({ servo: servoLabel(servo) }));
    for (const servo of among(moment.locked, staying))
      notices.tell('info', stayingSentence([servoLabel(servo)]));
    staying = [...moment.unknown, ...moment.locked];
    for (const servo of among(moment.atLimit, limited)) {
      notices.tell('info', words.pad.atLimit({ servo: servoLabel(servo), min: servo.min, max: servo.max }));
      limited = [...limited, servo.servo];
    }
  }

  device.store.subscribe(() => {
    const why = hindrance();
    if (why !== null && why !== 'busy' && store.getState().isDriving) drive(null);
  });
  let robotId = robots.current().id;
  robots.store.subscribe(() => {
    const { id } = robots.current();
    if (id !== robotId) drive(null);
    robotId = id;
  });
  // Places in the list mean other bindings now.
  mappings.store.subscribe(rest);

  return {
    store,
    inputs: () => inputs,
    frame() {
      const dtMs = Math.min(LONGEST_STEP_MS, clock.now() - lastMs);
      lastMs = clock.now();
      readInputs();
      if (listener !== null) {
        const moved = movedInput(listener.before, inputs);
        if (moved !== null) tellListener(moved);
        return;
      }
      obeyStop();
      if (!store.getState().isDriving || isAway) return;
      if (hindrance() === null) obey(dtMs);
      else rest();
    },
    drive,
    keyDown(code, isRepeat) {
      if (RESERVED_KEY.test(code)) return false;
      if (listener !== null) {
        tellListener({ kind: 'key', code });
        return true;
      }
      const isBound = mapping().bindings.some(({ input }) => input.kind === 'key' && input.code === code);
      const isTaken = isBound && store.getState().isDriving;
      if (isTaken && !isRepeat) keys.add(code);
      return isTaken;
    },
    keyUp: () => keys.clear(),
    leave() {
      isAway = true;
      rest();
    },
    comeBack: () => void (isAway = false),
    listen(heard) {
      rest();
      listener = { before: inputs, heard };
      return () => (listener = null);
    },
  };
}

// What pad and keys do to the robot at hand; a robot without an entry has its ready mapping. Moves nothing; pad.ts does what a
// mapping says.

export function createMappings(
  storage: TextStorage,
  notices: Notices,
  robots: RobotStore,
): RobotDocument<Mapping> {
  return createRobotDocument({
    ...{ storage, notices, robots, key: 'servodeck.mapping' },
    ...{
      notSaved: () => words.pad.notSaved,
      unreadable: (flaw) => words.pad.unreadable({ flaw: flawSentence(flaw) }),
    },
    ...{ fresh: readyMapping, toText: mappingToText, fromText: mappingFromText },
  });
}
