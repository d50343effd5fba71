// Servos on the body: as buttons that select them, or movable by drag and arrow keys while places are arranged. A drag is one undo step.

import {
  type CSSProperties,
  useRef,
  useState,
  type KeyboardEvent,
  type PointerEvent,
  type RefObject,
} from 'react';
import type { RobotServo, Robot } from '#shared/profile/robot.ts';
import { isHeld, selectByClick } from '../servoView.ts';
import { editServoView, useDevice, useServoView, useStores } from '../stores.ts';
import { Icon } from '../../ui/Icon.tsx';
import { selectHow } from '../../ui/inputEvents.ts';
import { numberAndName } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { Dial } from './Dial.tsx';
import { cx } from '../../ui/cx.ts';
import styles from './Place.module.css';

/** Names of more servos than this would overlap. */
const MOST_CALLED = 8;

interface PlaceProps {
  readonly servo: RobotServo;
  readonly order: readonly number[];
}

export function Place({ servo: own, order }: PlaceProps) {
  const { servo, name, place } = own;
  const stores = useStores();
  const isSelected = useServoView(({ selected }) => selected.includes(servo));
  const isLocked = useServoView((view) => isHeld(view, servo));
  const marks = isLocked ? [words.servoPanel.marks.locked] : [];
  return (
    <li className={styles.place} style={at(place)}>
      <button
        type="button"
        className={styles.button}
        aria-pressed={isSelected}
        aria-label={[numberAndName(servo, name), ...marks].join(words.comma)}
        onClick={(event) =>
          editServoView(stores, (view) => selectByClick(view, servo, selectHow(event), order))
        }
      >
        <PlaceFace servo={servo} isLocked={isLocked} />
        {order.length <= MOST_CALLED && (
          <span className={styles.called} aria-hidden="true">
            {name}
          </span>
        )}
      </button>
    </li>
  );
}

function PlaceFace({ servo, isLocked = false }: { servo: number; isLocked?: boolean }) {
  const family = useDevice((state) => state.family);
  return (
    <>
      <Dial servo={servo} family={family} />
      <span className={styles.number}>
        {words.numbers.formatWhole(servo)}
        {isLocked && <Icon name="lock" />}
      </span>
    </>
  );
}

const at = ({ x, y }: RobotServo['place']): CSSProperties => ({ left: `${x}%`, top: `${y}%` });

interface ArrangedPlaceProps {
  readonly servo: RobotServo;
  /** The element that places are percentages of. */
  readonly stage: RefObject<HTMLElement | null>;
}

export function ArrangedPlace({ servo: { servo, name, place }, stage }: ArrangedPlaceProps) {
  const { robots } = useStores();
  const [dragged, setDragged] = useState<PlaceAt | null>(null);
  /** The pointer's distance from its middle; null if it is not dragged. */
  const grip = useRef<{ readonly x: number; readonly y: number } | null>(null);

  function letGo(): void {
    grip.current = null;
    setDragged(null);
  }

  function put(to: PlaceAt | null): void {
    letGo();
    if (to !== null && (to.x !== place.x || to.y !== place.y))
      robots.edit(
        () => words.servoPanel.placeStep({ servo }),
        (robot) => withPlace(robot, servo, to),
      );
  }

  function take(event: PointerEvent<HTMLButtonElement>): void {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    const { left, top, width, height } = event.currentTarget.getBoundingClientRect();
    grip.current = { x: event.clientX - left - width / 2, y: event.clientY - top - height / 2 };
  }

  function drag(event: PointerEvent<HTMLButtonElement>): void {
    if (stage.current === null || grip.current === null) return;
    const { x, y } = grip.current;
    const middle = { clientX: event.clientX - x, clientY: event.clientY - y };
    setDragged(placeUnder(middle, stage.current.getBoundingClientRect()));
  }

  function push(event: KeyboardEvent): void {
    if (event.key === 'Escape') letGo();
    const to = placeBy(event, place);
    if (to === null) return;
    event.preventDefault();
    put(to);
  }

  return (
    <li className={styles.place} style={at(dragged ?? place)}>
      <button
        type="button"
        className={cx(styles.button, styles.arranged)}
        aria-label={words.servoPanel.placeOf({ ...place, name: numberAndName(servo, name) })}
        onPointerDown={take}
        onPointerMove={drag}
        onPointerUp={() => put(dragged)}
        onPointerCancel={letGo}
        onKeyDown={push}
      >
        <PlaceFace servo={servo} />
      </button>
    </li>
  );
}

function withPlace(robot: Robot, servo: number, place: PlaceAt): Robot {
  return { ...robot, servos: robot.servos.map((one) => (one.servo === servo ? { ...one, place } : one)) };
}

/** A place on the body, in whole percent of the picture's width and height. */
interface PlaceAt {
  readonly x: number;
  readonly y: number;
}

interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

const KEYS: Readonly<Record<string, readonly [x: number, y: number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
const SHIFT_STEP = 5;

export function placeUnder(
  pointer: { readonly clientX: number; readonly clientY: number },
  box: Box,
): PlaceAt {
  return {
    x: percent((pointer.clientX - box.left) / box.width),
    y: percent((pointer.clientY - box.top) / box.height),
  };
}

/** The place after an arrow key, further with Shift; null for other keys. */
export function placeBy(
  key: { readonly key: string; readonly shiftKey: boolean },
  { x, y }: PlaceAt,
): PlaceAt | null {
  const direction = KEYS[key.key];
  if (direction === undefined) return null;
  const step = key.shiftKey ? SHIFT_STEP : 1;
  return { x: percent((x + direction[0] * step) / 100), y: percent((y + direction[1] * step) / 100) };
}

/** The distance of the two nearest places, in percent. */
export function nearest(places: readonly PlaceAt[]): number {
  const gaps = places.flatMap((one, index) =>
    places.slice(index + 1).map((other) => Math.hypot(one.x - other.x, one.y - other.y)),
  );
  return Math.min(100, ...gaps);
}

const percent = (share: number): number => Math.round(Math.min(1, Math.max(0, share)) * 100);
