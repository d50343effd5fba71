// The panel for driving by keys and pad: the switch, the picture of the pad, the feel and the bindings.

import { useRef } from 'react';
import { conflicts, type Conflict, step } from '#shared/profile/mappingStep.ts';
import { isOfTip, type Mapping, servoBoundBy } from '#shared/profile/mapping.ts';
import type { PoseBook } from '#shared/profile/pose.ts';
import type { Robot } from '#shared/profile/robot.ts';
import {
  useMapping,
  usePoses,
  useRobot,
  usePad,
  useStores,
  useDevice,
  useServoView,
  useSnapshot,
} from '../stores.ts';
import { Mark } from '../../ui/Chip.tsx';
import { choosingTip, inputName, rowTitle, servoTitle } from './rows.ts';
import { words } from '../../i18n/whole.ts';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { isHeld } from '../servoView.ts';
import { Button } from '../../ui/Button.tsx';
import type { PanelParts } from '../../ui/Panel.tsx';
import { Choice, Toggle } from '../../ui/Toggle.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { bodyLinks } from '../picture/bodyLinks.ts';
import { UndoTools } from '../undo/UndoTools.tsx';
import { servoLabel } from '../../i18n/sentences.ts';
import { Bindings } from './Bindings.tsx';
import { FeelControls } from './FeelControls.tsx';
import { TiltControls } from './TiltControls.tsx';
import styles from './PadPanel.module.css';

/** Conflicts between bindings, in words. */
function Conflicts() {
  const mapping = useMapping();
  const robot = useRobot();
  const book = usePoses(({ present }) => present);
  const found = conflicts(mapping);
  if (found.length === 0) return null;
  return (
    <ul className={styles.list} aria-label={words.pad.conflicts}>
      {found.map((conflict) => {
        const sentence = sentenceOf(conflict, mapping, robot, book);
        return (
          <li key={sentence} className={styles.conflict}>
            <Mark truth="warning" />
            {sentence}
          </li>
        );
      })}
    </ul>
  );
}

function sentenceOf(conflict: Conflict, { bindings }: Mapping, robot: Robot, book: PoseBook): string {
  if (conflict.kind === 'sharedServo')
    return words.pad.sharedServo({ name: servoTitle(robot, conflict.servo) });
  const [one, other] = [bindings[conflict.one], bindings[conflict.other]];
  if (one === undefined || other === undefined) return '';
  const [first, second] = [one, other].map((binding) => rowTitle(binding, robot, book));
  const input = inputName(other.input);
  return first === second
    ? words.pad.sameInputTwice({ input, one: first ?? '' })
    : words.pad.sameInput({ input, one: first ?? '', other: second ?? '' });
}

/** Positions of the buttons of the browser's standard pad, by index. */
const ROUND: readonly (readonly [index: number, x: number, y: number, radius: number])[] = [
  [0, 178, 84, 9],
  [1, 196, 68, 9],
  [2, 160, 68, 9],
  [3, 178, 52, 9],
  [8, 104, 58, 5],
  [9, 136, 58, 5],
  [16, 120, 74, 7],
];
const SQUARE: readonly (readonly [index: number, x: number, y: number, width: number, height: number])[] = [
  [4, 38, 27, 48, 9],
  [5, 154, 27, 48, 9],
  [12, 56, 47, 12, 14],
  [13, 56, 75, 12, 14],
  [14, 41, 62, 14, 12],
  [15, 69, 62, 14, 12],
];
const TRIGGERS: readonly (readonly [index: number, x: number])[] = [
  [6, 42],
  [7, 162],
];
const STICKS: readonly (readonly [axis: number, button: number, x: number])[] = [
  [0, 10, 90],
  [2, 11, 150],
];
const STICK_Y = 108;
/** How far the drawing of a stick moves from the middle. */
const THROW = 11;

/** A live drawing of a pad, painted once a frame without React. Decorative: the list of bindings says the same in words. */
function PadPicture() {
  const { pad } = useStores();
  const seen = usePad((state) => state.pad);
  const drawing = useRef<SVGSVGElement>(null);

  useEachFrame(() => {
    const { axes, buttons } = pad.inputs();
    for (const part of drawing.current?.querySelectorAll<SVGElement>('[data-button]') ?? []) {
      const value = buttons[Number(part.dataset.button)] ?? 0;
      part.dataset.held = String(value > 0.1);
      part.style.setProperty('--value', value.toFixed(2));
    }
    for (const knob of drawing.current?.querySelectorAll<SVGElement>('[data-axis]') ?? []) {
      const axis = Number(knob.dataset.axis);
      const [x, y] = [axes[axis] ?? 0, axes[axis + 1] ?? 0].map((way) => (way * THROW).toFixed(1));
      knob.style.translate = `${x}px ${y}px`;
    }
  });

  return (
    <figure className={styles.figure} data-absent={seen === null}>
      <svg
        ref={drawing}
        className={styles.drawing}
        viewBox="0 0 240 160"
        role="img"
        aria-label={words.pad.picture}
      >
        <path className={styles.body} d={BODY} />
        {TRIGGERS.map(([index, x]) => (
          <g key={index} data-button={index}>
            <rect x={x} y={6} width={36} height={16} rx={5} className={styles.part} />
            <rect x={x} y={6} width={36} height={16} rx={5} className={styles.fill} />
          </g>
        ))}
        {SQUARE.map(([index, x, y, width, height]) => (
          <rect key={index} data-button={index} {...{ x, y, width, height }} rx={3} className={styles.part} />
        ))}
        {ROUND.map(([index, cx, cy, r]) => (
          <circle key={index} data-button={index} {...{ cx, cy, r }} className={styles.part} />
        ))}
        {STICKS.map(([axis, button, cx]) => (
          <g key={axis}>
            <circle cx={cx} cy={STICK_Y} r={20} className={styles.well} />
            <g data-axis={axis}>
              <circle cx={cx} cy={STICK_Y} r={12} data-button={button} className={styles.part} />
            </g>
          </g>
        ))}
      </svg>
      <figcaption className={styles.caption}>{captionOf(seen)}</figcaption>
    </figure>
  );
}

const BODY =
  'M62 30h116c26 0 40 18 47 50 7 33 10 62-8 68-16 5-26-20-38-20H61c-12 0-22 25-38 20-18-6-15-35-8-68 7-32 21-50 47-50z';

function captionOf(seen: { readonly name: string; readonly isStandard: boolean } | null): string {
  if (seen === null) return words.pad.noPad;
  return seen.isStandard ? seen.name : words.pad.otherPad;
}

export const padParts: PanelParts = {
  title: () => words.pad.title,
  Tools,
  Content,
  className: styles.panel,
};

function Content() {
  return (
    <>
      <p className={styles.hint}>
        <Hint />
      </p>
      <FirstMoves />
      <Moved />
      {matchMedia('(any-pointer: coarse)').matches && <TiltControls />}
      <div className={styles.top}>
        <PadPicture />
        <FeelControls />
      </div>
      <Conflicts />
      <Bindings />
    </>
  );
}

/** With three.js, which models are read by. */
const TipControls = laterComponent(
  async () => (await import('./TipControls.tsx')).TipControls,
  'var(--control)',
  'onDemand',
);

/** Whether the inputs move joints or the end of a limb; nothing to choose for robots without a limb that leads to a place. */
function Moved() {
  const { mappings } = useStores();
  const robot = useRobot();
  const isTip = isOfTip(useMapping());
  const hasTip =
    robot.model !== undefined || (bodyLinks(robot)?.some(({ joint }) => joint === 'tip') ?? false);
  if (!hasTip && !isTip) return null;
  return (
    <div className={styles.moved}>
      <Choice
        label={words.pad.moved}
        value={isTip ? 'tip' : 'joints'}
        options={[
          { value: 'joints', label: words.pad.joints },
          { value: 'tip', label: words.pad.tip },
        ]}
        onChange={(chosen) =>
          mappings.edit(
            () => words.pad.steps.moved,
            (mapping) => choosingTip(mapping, robot, chosen === 'tip'),
          )
        }
      />
      {isTip && <TipControls />}
    </div>
  );
}

function Hint() {
  const isDriving = usePad((state) => state.isDriving);
  const hindrance = useSnapshot(motionHindrance);
  if (hindrance !== null) return words.servos.blocked[hindrance];
  return isDriving ? words.pad.drivingHint : words.pad.driveHint;
}

function Tools() {
  const { pad, mappings } = useStores();
  const isDriving = usePad((state) => state.isDriving);
  const isBlocked = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  return (
    <>
      <UndoTools of={mappings} />
      <span className={styles.drive}>
        <Toggle
          label={words.pad.drive}
          isOn={isDriving}
          isDisabled={isBlocked && !isDriving}
          onChange={(isOn) => pad.drive(isOn ? step : null)}
        />
      </span>
    </>
  );
}

/** Driving by speed starts from a known position: servos without one need a slow first move. */
function FirstMoves() {
  const { device } = useStores();
  const { servos } = useRobot();
  const mapping = useMapping();
  const limb = usePad((state) => state.limb);
  const known = useDevice((state) => state.known);
  const isDriving = usePad((state) => state.isDriving);
  const view = useServoView((one) => one);
  const ofLimb = isOfTip(mapping) ? (limb?.servos ?? []) : [];
  const bound = new Set([...mapping.bindings.map(servoBoundBy), ...ofLimb]);
  const unknown = servos.filter(
    ({ servo }) => bound.has(servo) && !known.includes(servo) && !isHeld(view, servo),
  );
  if (!isDriving || unknown.length === 0) return null;
  const goHome = (): void => {
    const homes = unknown.map(({ servo, home }) => ({ servo, position: home }));
    device.move(homes, GENTLE_MOVE_MS);
  };
  return (
    <div className={styles.unknown}>
      <p>{words.pad.allUnknown({ names: words.numbers.formatNames(unknown.map(servoLabel)) })}</p>
      <Button icon="centre" hint={words.pad.firstMoveHint} onPress={goHome}>
        {words.pad.firstMove}
      </Button>
    </div>
  );
}
