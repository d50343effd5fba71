// The knob on the arc of the servo that is selected: turns it with a pointer. For the keys and for screen readers there is its slider
// below the picture, which is the same servo.

import { type PointerEvent, useRef } from 'react';
import { positionOf, type RobotServo } from '#shared/profile/robot.ts';
import { freeOf } from '../../servoView.ts';
import { useStores } from '../../stores.ts';
import { radiansOf } from './limbs.ts';
import type { Model } from './model.ts';
import { turnedBy } from './ring.ts';
import styles from './RobotView.module.css';

interface Hold {
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
  const hold = useRef<Hold | null>(null);

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
