// Driving by pad and keys: reads the inputs once a frame and sends moves by the robot's mapping. Off until a person switches it on, and
// off again after STOP or when link, pad or robot change. The code that maps inputs to moves is loaded with the panel. Knows no panel.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { Clock } from '#shared/clock.ts';
import {
  type Input,
  type Mapping,
  isOfTip,
  isPressed,
  movedInput,
  NO_INPUTS,
  type Inputs,
  readyMapping,
  mappingFromText,
  mappingToText,
  type Tilt,
} from '#shared/profile/mapping.ts';
import type { Begun, DriveState, step, TipDriver, TipMoment, TipSpeed } from '#shared/profile/mappingStep.ts';
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
import type { Undoable } from '../../state/store.ts';
import type { TextStorage } from '../../state/storage.ts';
import { createRobotDocument, type RobotDocument } from '../profiles/robotDocument.ts';
import { isTextField } from '../../ui/inputEvents.ts';

/** The part of the browser's `Gamepad` in use. */
export interface Gamepadlike {
  readonly id: string;
  readonly index: number;
  readonly mapping: string;
  readonly axes: readonly number[];
  readonly buttons: readonly { readonly value: number }[];
}

export interface PadState {
  readonly isDriving: boolean;
  /** null without a pad. Browsers hide a pad until it is used. */
  readonly pad: { readonly name: string; readonly isStandard: boolean } | null;
  /** The limb whose end the inputs move, where a mapping has that; null until its code is loaded. */
  readonly limb: {
    readonly tip: string;
    readonly servos: readonly number[];
    readonly isShort: boolean;
  } | null;
}

export interface Pad {
  readonly store: StoreApi<PadState>;
  /** The inputs in the last frame, for pictures. */
  inputs(): Inputs;
  /** Call once a frame. */
  frame(): void;
  /** Starts driving with the code that maps inputs to moves; null ends it. */
  drive(by: typeof step | null): void;
  /** Called once a frame; null: there is no tilt that counts. */
  tiltBy(read: (() => Tilt | null) | null): void;
  /** Used until the profile changes. */
  lead(by: TipDriver | null): void;
  /** True if a binding uses the key, so that the event must not go further. */
  keyDown(code: string, isRepeat: boolean): boolean;
  /** Releasing any key releases all, so that a missing keyup cannot leave one stuck. */
  keyUp(): void;
  /** The page is hidden or lost the focus: inputs are ignored until `comeBack`. */
  leave(): void;
  comeBack(): void;
  /** Reports the next input that is moved instead of acting on it. Returns a function that ends the waiting. */
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
  /** The browser's pads; may throw if the page has no permission. */
  readPads(): readonly (Gamepadlike | null)[];
}

/** A late frame must not cause a jump. */
const LONGEST_STEP_MS = 100;
/** Keys for STOP, focus navigation and modifiers. */
const RESERVED_KEY = /^(Escape|Tab|CapsLock|(Shift|Control|Alt|Meta)(Left|Right))$/;

export function createPad(options: PadOptions): Pad {
  const { device, robots, view, poses, mappings, notices, clock, readPads } = options;
  const store = createStore<PadState>(() => ({ isDriving: false, pad: null, limb: null }));
  const keys = new Set<string>();
  let inputs = NO_INPUTS;
  let takeStep: typeof step | null = null;
  let readTilt: (() => Tilt | null) | null = null;
  let tipDriver: TipDriver | null = null;
  let driven: DriveState | undefined;
  let lastMs = clock.now();
  let isAway = false;
  /** Locked servos that were driven and already reported. */
  let staying: readonly number[] = [];
  /** Servos whose limit was reported since driving began: a gripper is at its limits all the time. */
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
    moveTip(null, 0);
  }

  function lead(by: TipDriver | null): void {
    moveTip(null, 0);
    tipDriver = by;
    store.setState({ limb: by && { tip: by.tip, servos: by.servos, isShort: false } });
  }

  function moveTip(speed: TipSpeed | null, dtMs: number): Omit<TipMoment, 'isShort'> {
    if (tipDriver === null) return { moves: [], unknown: [] };
    const moment = tipDriver.step(speed, dtMs);
    const { limb } = store.getState();
    if (limb !== null && limb.isShort !== moment.isShort)
      store.setState({ limb: { ...limb, isShort: moment.isShort } });
    return moment;
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
      tilt: readTilt?.() ?? null,
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
      notices.show('warning', words.pad.gone);
    }
  }

  function tellListener(input: Input): void {
    const heard = listener?.heard;
    listener = null;
    // The finger is still on the input; the binding applies from its next press.
    stopWasPressed = true;
    rest();
    heard?.(input);
  }

  /** Stop by pad works without the switch. */
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
    const tip = moveTip(moment.tip, dtMs);
    const own = moment.moves.map(({ servo }) => servo);
    const moves = [...moment.moves, ...tip.moves.filter(({ servo }) => !own.includes(servo))];
    if (moves.length > 0) device.move(moves, 'hand');
    moment.begun.forEach(begin);
    const among = (servos: readonly number[], wanted: readonly number[]): readonly RobotServo[] =>
      robot.servos.filter(({ servo }) => servos.includes(servo) && !wanted.includes(servo));
    const unknown = [...moment.unknown, ...tip.unknown];
    for (const servo of among(unknown, staying))
      notices.show('warning', words.pad.unknown({ servo: servoLabel(servo) }));
    for (const servo of among(moment.locked, staying))
      notices.show('info', stayingSentence([servoLabel(servo)]));
    staying = [...unknown, ...moment.locked];
    for (const servo of among(moment.atLimit, limited)) {
      notices.show('info', words.pad.atLimit({ servo: servoLabel(servo), min: servo.min, max: servo.max }));
      limited = [...limited, servo.servo];
    }
  }

  device.store.subscribe(() => {
    const why = hindrance();
    if (why !== null && why !== 'busy' && store.getState().isDriving) drive(null);
  });
  let robotId = robots.current().id;
  robots.store.subscribe(() => {
    const { id, robot } = robots.current();
    const isStale = tipDriver !== null && tipDriver.robot !== robot;
    if (id !== robotId || (isStale && isOfTip(mapping()))) drive(null);
    if (isStale) lead(null);
    robotId = id;
  });
  // The indices now belong to other bindings.
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
    tiltBy: (read) => void (readTilt = read),
    lead,
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

// What pad and keys do to the current robot; a robot without an entry has its ready mapping. Moves nothing; pad.ts does what a
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

type Listener = Pick<Pad, 'keyDown' | 'keyUp' | 'leave' | 'comeBack'>;

export function watchInputs(page: Pick<Window, 'addEventListener' | 'document'>, pad: Listener): void {
  const { document } = page;
  page.addEventListener(
    'keydown',
    (event) => {
      const isForOthers = event.ctrlKey || event.metaKey || event.altKey || isTextField(event.target);
      if (isForOthers || !pad.keyDown(event.code, event.repeat)) return;
      event.preventDefault();
      event.stopPropagation();
    },
    { capture: true },
  );
  page.addEventListener('keyup', () => pad.keyUp(), { capture: true });
  page.addEventListener('blur', () => pad.leave());
  page.addEventListener('focus', () => pad.comeBack());
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'hidden') pad.leave();
    else if (document.hasFocus()) pad.comeBack();
  });
}
