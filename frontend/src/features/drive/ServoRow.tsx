// The row of one servo: dial, name, slider, value. Target and estimate are drawn without React, so that dozens can move in each frame.

import { memo, useRef, type Ref } from 'react';
import { fromBoard, servoOf, type RobotServo } from '#shared/profile/robot.ts';
import {
  useRobot,
  useSnapshot,
  useStores,
  useDevice,
  useGuess,
  useServoView,
  useView,
  editServoView,
} from '../stores.ts';
import { Chip } from '../../ui/Chip.tsx';
import { useNow } from '../../ui/useEachFrame.ts';
import { words, useWords } from '../../i18n/words.ts';
import { type Scale, scaleOf, stepped } from './scale.ts';
import { MovingText } from '../picture/MovingText.tsx';
import { mayBrush, motionHindrance, tellsPositions } from '../../robot/readiness.ts';
import { isHeld, selectByClick } from '../servoView.ts';
import { cx } from '../../ui/cx.ts';
import { Sight, useSight } from '../../ui/sight.ts';
import { NumberField } from '../../ui/NumberField.tsx';
import { servoLabel, numberAndName } from '../../i18n/sentences.ts';
import { Estimate, PositionSlider } from './PositionSlider.tsx';
import { useServoMoves } from './useServoMoves.ts';
import { targetOf } from '../picture/motion.ts';
import { useWheelSteps } from './useDrag.ts';
import styles from './ServoRow.module.css';
import { Dial } from '../picture/Dial.tsx';
import { Icon } from '../../ui/Icon.tsx';
import { selectHow } from '../../ui/inputEvents.ts';

const AGE_REFRESH_MS = 1000;

/** The position that the board reported, with its age. */
function Reported({ servo, scale }: { readonly servo: number; readonly scale: Scale }) {
  const { device } = useStores();
  const robot = useRobot();
  const reading = useSnapshot((snapshot) => snapshot.reported[servo]);
  const nowMs = useNow(device.clock.now, AGE_REFRESH_MS);
  if (reading === undefined) return null;
  return (
    <span className={styles.reported} role="group" title={words.truth.confirmed}>
      <Chip truth="confirmed">{scale.digits(fromBoard(robot, servo, reading.position))}</Chip>
      <span className={styles.age}>{words.numbers.formatAge(nowMs - reading.atMs)}</span>
    </span>
  );
}

interface ServoRowProps {
  readonly servo: RobotServo;
  /** All servos of the list from top to bottom, for selecting a range. */
  readonly order: readonly number[];
}

export const ServoRow = memo(function ServoRow({ servo: own, order }: ServoRowProps) {
  const { servo } = own;
  useWords();
  const row = useRef<HTMLLIElement>(null);
  const name = useRef<HTMLButtonElement>(null);
  const isInSight = useSight(row);
  const isSelected = useServoView(({ selected }) => selected.includes(servo));
  return (
    <li ref={row} className={cx(styles.row, isSelected && styles.selected)}>
      <Sight value={isInSight}>
        <ServoName ref={name} servo={own} order={order} />
        <ServoControls
          servo={own}
          // The row under the finger may be behind the picture, which stays in sight.
          onHeld={() => name.current?.scrollIntoView({ block: 'nearest' })}
        />
      </Sight>
    </li>
  );
});

interface ServoControlsProps {
  readonly servo: RobotServo;
  /** Called when a finger takes the slider. */
  onHeld(): void;
}

function ServoControls({ servo: own, onHeld }: ServoControlsProps) {
  const { servo } = own;
  const { device } = useStores();
  const servoMoves = useServoMoves();
  const family = useDevice((state) => state.family);
  const isKnown = useDevice((state) => state.known.includes(servo));
  const isRead = useDevice((state) => state.readServos.includes(servo));
  const guess = useGuess(own);
  const scale = scaleOf(
    own,
    family,
    useView((state) => state.positionsIn),
  );
  const hindrance = useSnapshot(motionHindrance);
  const isLocked = useServoView((view) => isHeld(view, servo));
  const isTelling = tellsPositions(family);
  const blocked = hindrance !== null || isLocked;
  const area = useRef<HTMLDivElement>(null);
  /** While a refusal is shown, the wheel scrolls. */
  const isRefused = useRef(false);
  const refusal = useRef<(() => void) | null>(null);
  const touch = (): void => {
    isRefused.current = false;
  };
  /** Removes the message about an earlier refusal. */
  const take = (): void => {
    touch();
    refusal.current?.();
    refusal.current = null;
  };
  const move = (position: number): void => {
    take();
    servoMoves.move(servo, position);
  };
  const leap = (position: number): void => {
    take();
    servoMoves.leap(servo, position);
  };
  /** Held by a finger. */
  const isNewlyHeld = useRef(false);
  const drag = (position: number): void => {
    if (isNewlyHeld.current) onHeld();
    isNewlyHeld.current = false;
    take();
    servoMoves.drag(servo, position);
  };
  useWheelSteps(area, {
    mayStep: () =>
      !isLocked && !isRefused.current && mayBrush(device.store.getState().snapshot, device.motion(servo)),
    step(change, isFar) {
      const from = targetOf(device, servo);
      if (from !== null) move(stepped(scale, from, change * scale.step * (isFar ? 10 : 1)));
    },
  });

  return (
    <div
      ref={area}
      className={styles.controls}
      onFocus={touch}
      onPointerDown={({ pointerType }) => {
        touch();
        isNewlyHeld.current = pointerType === 'touch';
      }}
      // On the complete press, so that a finger that scrolls past does not request the robot.
      onPointerUp={() => hindrance === 'watching' && device.lease('request')}
    >
      <PositionSlider
        {...{ servo: own, family, scale, isKnown, isRead, guess, blocked }}
        onMove={move}
        onLeap={leap}
        onDrag={drag}
        onHome={() => servoMoves.home([servo])}
      />
      <TargetField
        {...{ servo: own, scale, isKnown, isRead, guess, blocked }}
        onStep={move}
        onTyped={(position) => {
          touch();
          return servoMoves.place(servo, position);
        }}
        onRefused={(takeBack) => {
          isRefused.current = true;
          refusal.current = takeBack;
        }}
      />
      <div className={styles.readings}>
        <Estimate servo={servo} scale={scale} />
        {isTelling && <Reported servo={servo} scale={scale} />}
      </div>
    </div>
  );
}

interface TargetFieldProps {
  readonly servo: RobotServo;
  readonly scale: Scale;
  readonly isKnown: boolean;
  readonly isRead: boolean;
  readonly guess: number | null;
  readonly blocked: boolean;
  onStep(position: number): void;
  /** Returns the linked servo that stopped the move at its limit, if any. */
  onTyped(position: number): number | null;
  onRefused(takeBack: () => void): void;
}

function TargetField(props: TargetFieldProps) {
  const { servo: own, scale, isKnown, isRead, guess, blocked, onStep, onTyped, onRefused } = props;
  const { device, notices, robots, view } = useStores();
  const source = isRead ? 'confirmed' : 'commanded';
  const shown = (): number | null => {
    const target = targetOf(device, own.servo);
    return target === null ? null : scale.shown(target);
  };
  const tellStop = (first: number): void => {
    const met = servoOf(robots.current().robot, first);
    if (met === undefined) return;
    const read = scaleOf(met, device.store.getState().family, view.getState().positionsIn);
    notices.show(
      'warning',
      words.servoPanel.stoppedBy({ name: servoLabel(met), min: read.text(met.min), max: read.text(met.max) }),
    );
  };
  const take = (wanted: number, isStep: boolean): void => {
    const position = scale.position(wanted);
    const first = isStep ? null : onTyped(position);
    if (isStep) onStep(position);
    if (first !== null) tellStop(first);
  };
  const refuse = (wanted: number): (() => void) => {
    const takeBack = notices.refuse(refusal(own, wanted, scale));
    onRefused(takeBack);
    return takeBack;
  };
  return (
    <NumberField
      label={words.servos.target({ servo: own.servo })}
      size="large"
      truth={isKnown ? { mark: source, title: words.truth[source] } : undefined}
      value={{ now: shown, Show: MovingText }}
      {...{ min: scale.min, max: scale.max, unit: scale.unit, decimals: scale.decimals, step: scale.step }}
      placeholder={
        isKnown
          ? ''
          : guess === null
            ? words.servos.unknown
            : words.firstMoves.guessed({ position: scale.digits(guess) })
      }
      start={scale.shown(guess ?? own.home)}
      isReadOnly={blocked}
      onChange={take}
      onRefused={refuse}
    />
  );
}

function refusal(servo: RobotServo, shown: number, { min, max, unit }: Scale) {
  const text = (value: number): string => (unit === '°' ? `${value}°` : `${value}`);
  return words.servoPanel.refused({
    name: servoLabel(servo),
    value: text(shown),
    min: text(min),
    max: text(max),
  });
}

interface ServoNameProps {
  readonly ref: Ref<HTMLButtonElement>;
  readonly servo: RobotServo;
  readonly order: readonly number[];
}

/** The dial and the name as one button that selects the servo: alone, added with Ctrl or by touch, as a range with Shift. */
function ServoName({ ref, servo: own, order }: ServoNameProps) {
  const { servo, name: joint, isReversed } = own;
  const stores = useStores();
  const family = useDevice((state) => state.family);
  const isSelected = useServoView(({ selected }) => selected.includes(servo));
  const isLocked = useServoView((view) => isHeld(view, servo));
  const name = words.servos.name({ servo });

  const said = [
    ...(isReversed ? [words.servoPanel.marks.reversed] : []),
    ...(isLocked ? [words.servoPanel.marks.locked] : []),
  ];
  return (
    <button
      ref={ref}
      type="button"
      className={styles.name}
      aria-pressed={isSelected}
      aria-label={[numberAndName(servo, joint), ...said].join(words.comma)}
      onClick={(event) =>
        editServoView(stores, (view) => selectByClick(view, servo, selectHow(event), order))
      }
    >
      <Dial servo={servo} family={family} />
      <span className={styles.texts}>
        <span className={styles.joint}>{joint || name}</span>
        <span className={styles.number}>
          {isReversed && <Icon name="reverse" />}
          {isLocked && <Icon name="lock" />}
          {joint && joint !== name && name}
        </span>
      </span>
    </button>
  );
}
