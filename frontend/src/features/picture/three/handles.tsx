// What moves servos in the picture in three dimensions: the handle at the end of a limb with its fields in millimetres, and the knob on the arc
// of the selected servo. A target is treated as a slider's: soft limit, locks, driver and STOP.

import styles from './RobotView.module.css';
import { type KeyboardEvent, type PointerEvent, useRef, useState } from 'react';
import { Plane, Vector3 } from 'three';
import { lengthOf, minus, type Vec3 } from '#shared/kinematics/model.ts';
import { type Robot, servoOf, positionOf, type RobotServo } from '#shared/profile/robot.ts';
import { words } from '../../../i18n/whole.ts';
import { Button } from '../../../ui/Button.tsx';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { freeOf, isLocked } from '../../servoView.ts';
import { guessNow, usePad, useStores, type Stores } from '../../stores.ts';
import { useMotions } from '../useMotions.ts';
import {
  type LedLimb,
  inMm,
  type Leading,
  type Led,
  flipElbow,
  leadTo,
  poseOfLimb,
  takeLimb,
  radiansOf,
  type LeadMode,
} from './limbs.ts';
import type { Model } from './model.ts';
import { turnedBy } from './ring.ts';

const STEP_M = { fine: 0.001, coarse: 0.01 };
/** A place that is missed by more is out of reach. */
const SHORT_M = 0.003;
const FIELD_MM = { min: -1000, max: 1000 };

interface LimbProps {
  readonly limb: LedLimb;
  readonly isLevel: boolean;
  readonly isBlocked: boolean;
}

interface LimbHandleProps extends LimbProps {
  model(): Model | null;
  onElement(element: HTMLButtonElement | null): void;
}

/** A pointer that holds a handle goes along the plane through the tip that faces the eye. */
interface Hold {
  readonly pointer: number;
  readonly plane: Plane;
  readonly besideTip: Vector3;
  leading: Leading;
  /** Where the tip was wished last. */
  wished: Vec3;
}

/** Sits over the end of a limb; moved past React. */
export function LimbHandle({ limb, isLevel, isBlocked, model, onElement }: LimbHandleProps) {
  const stores = useStores();
  const hold = useRef<Hold | null>(null);
  const [isHeld, setHeld] = useState(false);
  const [isShort, setShort] = useState(false);
  const isShortByPad = usePad(({ limb: led }) => led?.tip === limb.tip && led.isShort);

  function press(event: PointerEvent<HTMLButtonElement>): void {
    const room = model();
    const leading = limbNow(stores, limb);
    if (event.button !== 0 || room === null || leading === null) return;
    const tip = tipInRoom(leading, room);
    const facing = room.stage.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(facing, tip);
    const at = pointOn(plane, room, event) ?? tip;
    const wished = poseOfLimb(leading).tip;
    hold.current = { pointer: event.pointerId, plane, besideTip: tip.clone().sub(at), leading, wished };
    event.currentTarget.setPointerCapture(event.pointerId);
    setHeld(true);
  }

  function move(event: PointerEvent<HTMLButtonElement>): void {
    const room = model();
    const held = hold.current;
    if (held === null || room === null || held.pointer !== event.pointerId) return;
    const at = pointOn(held.plane, room, event)?.add(held.besideTip);
    if (at === undefined) return;
    const wished: Vec3 = [at.x, at.y, at.z - room.liftM()];
    const askedM = lengthOf(minus(wished, held.wished));
    const led = lead(stores, held.leading, wished, isLevel, { how: 'follow', askedM });
    held.leading = led.leading;
    held.wished = wished;
    setShort(led.missM > SHORT_M);
  }

  function release(): void {
    hold.current = null;
    setHeld(false);
    setShort(false);
  }

  function step(event: KeyboardEvent): void {
    const way = WAYS[event.key];
    const leading = limbNow(stores, limb);
    if (way === undefined || leading === null) return;
    event.preventDefault();
    const by = event.shiftKey ? STEP_M.coarse : STEP_M.fine;
    const { tip } = poseOfLimb(leading);
    const wished: Vec3 = [tip[0] + way[0] * by, tip[1] + way[1] * by, tip[2] + way[2] * by];
    // One press gets its millimetre also beside the axis of the base; a key that is held asks as a hand does.
    const askedM = event.repeat ? by : STEP_M.coarse;
    lead(stores, leading, wished, isLevel, { how: 'follow', askedM });
  }

  return (
    <button
      ref={onElement}
      type="button"
      className={styles.handle}
      aria-label={words.robot3d.handle({ limb: nameOf(limb, stores.robots.current().robot) })}
      title={words.robot3d.handleHint}
      disabled={isBlocked}
      data-held={isHeld}
      data-short={isShort || isShortByPad}
      onPointerDown={press}
      onPointerMove={move}
      onPointerUp={release}
      onPointerCancel={release}
      onLostPointerCapture={release}
      onKeyDown={step}
    />
  );
}

const pointOn = (plane: Plane, { stage }: Model, { clientX, clientY }: PointerEvent): Vector3 | null =>
  stage.rayAt(clientX, clientY).ray.intersectPlane(plane, new Vector3());

/** Forward, left and up, as in URDF. */
const WAYS: Readonly<Record<string, Vec3>> = {
  ArrowRight: [1, 0, 0],
  ArrowLeft: [-1, 0, 0],
  ArrowUp: [0, 0, 1],
  ArrowDown: [0, 0, -1],
  PageUp: [0, 1, 0],
  PageDown: [0, -1, 0],
};

/** Puts the handles over the ends of their limbs; those whose place is not known are hidden. */
export function placeHandles(
  stores: Stores,
  model: Model,
  limbs: readonly LedLimb[],
  handles: ReadonlyMap<string, HTMLElement>,
  canvas: HTMLElement,
): void {
  const { left, top } = canvas.getBoundingClientRect();
  for (const limb of limbs) {
    const handle = handles.get(limb.tip);
    const leading = limbNow(stores, limb);
    if (handle === undefined) continue;
    handle.style.visibility = leading === null ? 'hidden' : '';
    if (leading === null) continue;
    const { x, y } = model.stage.onPage(tipInRoom(leading, model));
    handle.style.translate = `${x - left}px ${y - top}px`;
  }
}

const AXES = ['x', 'y', 'z'] as const;

/** Where the tip was sent, in millimetres from the middle of the base. */
export function PlaceFields({ limb, isLevel, isBlocked }: LimbProps) {
  const stores = useStores();
  const [place, setPlace] = useState<Vec3 | null>(() => placeNow(stores, limb));
  useMotions(limb.servos, () => {
    const now = placeNow(stores, limb);
    setPlace((before) => (before?.join() === now?.join() ? before : now));
  });

  function go(index: number, mm: number): void {
    const leading = limbNow(stores, limb);
    if (leading === null || place === null) return;
    const { tip } = poseOfLimb(leading);
    const along = (axis: number): number => (axis === index ? mm / 1000 : (tip[axis] ?? 0));
    const { missM } = lead(stores, leading, [along(0), along(1), along(2)], isLevel, { how: 'reach' });
    if (missM > SHORT_M)
      stores.notices.refuse(words.robot3d.outOfReach({ missMm: Math.round(missM * 1000) }));
  }

  return (
    <div className={styles.place} role="group" aria-label={words.robot3d.place}>
      {AXES.map((axis, index) => (
        <span key={axis} className={styles.axis}>
          <span aria-hidden="true">{axis.toUpperCase()}</span>
          <CheckedNumber
            label={words.robot3d.axes[axis]}
            value={place?.[index] ?? null}
            {...FIELD_MM}
            unit={words.robot3d.mm}
            size="small"
            isDisabled={isBlocked || place === null}
            onChange={(mm) => go(index, mm)}
          />
        </span>
      ))}
    </div>
  );
}

/** One slow move of the whole arm; the tip leaves its place on the way. */
export function ElbowButton({ limb, isLevel, isBlocked }: LimbProps) {
  const stores = useStores();

  function turn(): void {
    const leading = limbNow(stores, limb);
    if (leading === null) return;
    const targets = flipElbow(leading, stores.robots.current().robot, {
      rise: isLevel ? 0 : null,
      isLocked: (servo) => isLocked(stores, servo),
    });
    if (targets === null) stores.notices.refuse(words.robot3d.noOtherElbow);
    else stores.device.move(freeOf(stores, targets), 'leap');
  }

  return (
    <Button tone="quiet" isDisabled={isBlocked} onPress={turn}>
      {words.robot3d.otherElbow}
    </Button>
  );
}

function placeNow(stores: Stores, limb: LedLimb): Vec3 | null {
  const leading = limbNow(stores, limb);
  return leading === null ? null : inMm(poseOfLimb(leading).tip);
}

/** From where its servos were sent, else where they may stand. */
function limbNow(stores: Stores, limb: LedLimb): Leading | null {
  const motion = stores.device.motions();
  return takeLimb(limb, stores.robots.current().robot, (servo) => {
    const { target, estimated } = motion(servo.servo);
    return target ?? estimated ?? guessNow(stores, servo);
  });
}

function tipInRoom(leading: Leading, model: Model): Vector3 {
  const [x, y, z] = poseOfLimb(leading).tip;
  return new Vector3(x, y, z + model.liftM());
}

/** A drag streams as a slider does; a typed place is one slow move, or none where it is out of reach. */
function lead(stores: Stores, leading: Leading, tip: Vec3, isLevel: boolean, mode: LeadMode): Led {
  const led = leadTo(leading, stores.robots.current().robot, {
    ...{ tip, mode, rise: isLevel ? 0 : null },
    isLocked: (servo) => isLocked(stores, servo),
  });
  const free = freeOf(stores, led.targets);
  if (mode.how === 'follow') stores.device.drag(free, 'hand');
  else if (led.missM <= SHORT_M) stores.device.move(free, 'leap');
  return led;
}

/** By the servo before its end, or by the limb that people have named. */
export function nameOf({ servos }: LedLimb, robot: Robot): string {
  const last = servoOf(robot, servos.at(-1) ?? 0);
  if (last === undefined) return '';
  return last.group === '' ? last.name : last.group;
}

interface Turn {
  readonly pointer: number;
  radians: number;
  x: number;
  y: number;
}

export function JointKnob({
  servo,
  model,
  onElement,
}: {
  readonly servo: RobotServo;
  model(): Model | null;
  onElement(element: HTMLElement | null): void;
}) {
  const stores = useStores();
  const hold = useRef<Turn | null>(null);

  function press(event: PointerEvent<HTMLSpanElement>): void {
    const { target } = stores.device.motion(servo.servo);
    if (event.button !== 0 || target === null) return;
    const { pointerId: pointer, clientX: x, clientY: y } = event;
    hold.current = { pointer, radians: radiansOf(servo, target), x, y };
    event.currentTarget.setPointerCapture(pointer);
  }

  function move(event: PointerEvent): void {
    const [held, shown] = [hold.current, model()];
    const ring = shown?.ring() ?? null;
    if (held?.pointer !== event.pointerId || shown === null || ring === null) return;
    const moved = { x: event.clientX - held.x, y: event.clientY - held.y };
    held.radians += turnedBy(ring, shown.stage, held.radians, moved);
    [held.x, held.y] = [event.clientX, event.clientY];
    const wanted = positionOf(servo, (held.radians / Math.PI) * 180);
    const position = Math.min(servo.max, Math.max(servo.min, wanted));
    const free = freeOf(stores, [{ servo: servo.servo, position }]);
    if (free.length > 0) stores.device.drag(free, 'hand');
  }

  return (
    <span
      ref={onElement}
      className={styles.knob}
      aria-hidden="true"
      onPointerDown={press}
      onPointerMove={move}
      onPointerUp={() => (hold.current = null)}
      onPointerCancel={() => (hold.current = null)}
    />
  );
}

/** Over the arc where the servo was sent; hidden where that is unknown. */
export function placeKnob(
  model: Model,
  servo: RobotServo,
  target: number | null,
  knob: HTMLElement,
  canvas: HTMLElement,
): void {
  const ring = model.ring();
  knob.style.visibility = ring === null || target === null ? 'hidden' : '';
  if (ring === null || target === null) return;
  const { left, top } = canvas.getBoundingClientRect();
  const { x, y } = model.stage.onPage(ring.knobAt(radiansOf(servo, target)));
  knob.style.translate = `${x - left}px ${y - top}px`;
}
