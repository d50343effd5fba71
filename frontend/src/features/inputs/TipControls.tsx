// Moves the end of a limb along straight lines by the sticks: one step of it as a pure function, the driver for pad.ts, and the controls
// beside the choice. What is out of reach, too fast for a servo or beyond a limit is not sent. Loaded on request, with three.js.

import { useEffect, useMemo } from 'react';
import type { ServoTarget } from '#shared/codec/commands.ts';
import { RISE_M } from '#shared/kinematics/inverse.ts';
import { added, minus, lengthOf, scaled, type Vec3 } from '#shared/kinematics/model.ts';
import type { TipChoice } from '#shared/profile/mapping.ts';
import {
  LEAD,
  type ServoPlace,
  type TipDriver,
  type TipMoment,
  type TipSpeed,
} from '#shared/profile/mappingStep.ts';
import { type Robot, servoOf } from '#shared/profile/robot.ts';
import { RANGE_MS } from '#shared/robot/timings.ts';
import { words } from '../../i18n/whole.ts';
import { Select } from '../../ui/Select.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { parseUrdf } from '../picture/three/figure.ts';
import { nameOf } from '../picture/three/handles.tsx';
import {
  type LedLimb,
  type Leading,
  leadTo,
  limbsOfModel,
  poseOfLimb,
  radiansOf,
  takeLimb,
} from '../picture/three/limbs.ts';
import { useModel } from '../picture/three/useModel.ts';
import { isLocked } from '../servoView.ts';
import { type Stores, useMapping, usePad, useRobot, useStores } from '../stores.ts';
import styles from './PadPanel.module.css';

export interface Arm {
  readonly limb: LedLimb;
  readonly robot: Robot;
  readonly isLevel: boolean;
  /** Board units that a servo turns in a second at most. */
  readonly unitsPerS: number;
  place(servo: number): ServoPlace;
  isLocked(servo: number): boolean;
}

/** Where the tip was sent, exactly: servos know only whole units. */
interface TipState {
  readonly leading: Leading;
  readonly tip: Vec3;
  readonly sent: readonly ServoTarget[];
}

interface TipStep extends TipMoment {
  readonly state: TipState | null;
}

const STAYS: TipStep = { state: null, moves: [], unknown: [], isShort: false };
/** From its line, in metres: with the rounding to whole units it is less than a millimetre. */
const OFF_LINE_M = 2e-4;
/** Where a servo cannot follow the whole step, a part of it. */
const SHARES = [1, 0.5, 0.25, 0.1];
/** How fast an end that has to be level gets there, and what still counts as level: both as the sine of its rise. */
const RISE_PER_S = 0.8;
const LEVEL = 0.02;

export function tipStep(arm: Arm, speed: TipSpeed | null, dtMs: number, before: TipState | null): TipStep {
  if (speed === null) return STAYS;
  const { limb, robot, place } = arm;
  const places = limb.servos.map(place);
  const unknown = limb.servos.filter((servo) => {
    const { target, estimated } = place(servo);
    return target === null && estimated === null;
  });
  if (unknown.length > 0) return { ...STAYS, unknown };
  // On a slow first move: it is followed once it has arrived.
  if (places.some(({ estimated }) => estimated === null)) return STAYS;
  const from = isAsSent(before, arm) ? before : begin(arm);
  if (from === null) return STAYS;
  if (limb.servos.some((servo) => isAhead(robot, servo, place(servo)))) return { ...STAYS, state: from };
  for (const share of SHARES)
    for (const rise of risesFrom(arm, from, dtMs)) {
      const next = stepBy(arm, from, { by: scaled(speed, dtMs / 1e6), share, rise }, dtMs);
      if (next === null) continue;
      const moves = next.sent.filter(({ servo, position }) => position !== place(servo).target);
      return { ...STAYS, state: next, moves };
    }
  return { ...STAYS, state: from, isShort: true };
}

const isAsSent = (before: TipState | null, { place }: Arm): before is TipState =>
  before?.sent.every(({ servo, position }) => place(servo).target === position) ?? false;

function begin({ limb, robot, place }: Arm): TipState | null {
  const leading = takeLimb(withinLimits(limb, robot), robot, ({ servo }) => {
    const { target, estimated } = place(servo);
    return target ?? estimated;
  });
  if (leading === null) return null;
  const sent = limb.servos.flatMap((servo) => {
    const { target } = place(servo);
    return target === null ? [] : [{ servo, position: target }];
  });
  return { leading, tip: poseOfLimb(leading).tip, sent };
}

/** A model may let a joint turn farther than its servo. */
function withinLimits(limb: LedLimb, robot: Robot): LedLimb {
  const joints = limb.chain.joints.map((joint, index) => {
    const servo = servoOf(robot, limb.servos[index] ?? 0);
    if (servo === undefined) return joint;
    const ends = [radiansOf(servo, servo.min), radiansOf(servo, servo.max)];
    return {
      ...joint,
      min: Math.max(joint.min, Math.min(...ends)),
      max: Math.min(joint.max, Math.max(...ends)),
    };
  });
  return { ...limb, chain: { ...limb.chain, joints } };
}

function isAhead(robot: Robot, number: number, { target, estimated }: ServoPlace): boolean {
  const servo = servoOf(robot, number);
  if (servo === undefined || target === null || estimated === null) return false;
  return Math.abs(target - estimated) > (servo.max - servo.min) * LEAD;
}

/** Nearer to level, else as it is: the place where the limb can be level may be farther along the line. */
function risesFrom({ isLevel }: Arm, { leading }: TipState, dtMs: number): readonly (number | null)[] {
  if (!isLevel) return [null];
  const rise = poseOfLimb(leading).pointing[2];
  const nearer = Math.sign(rise) * Math.max(0, Math.abs(rise) - (RISE_PER_S * dtMs) / 1000);
  return Math.abs(rise) > LEVEL ? [nearer, rise] : [nearer];
}

interface Wanted {
  /** What the hand asks for, of which the tip goes a share: where joints have to turn far it slows down. */
  readonly by: Vec3;
  readonly share: number;
  readonly rise: number | null;
}

/** null where the tip would leave its line, or a servo could not follow. */
function stepBy(arm: Arm, from: TipState, { by, share, rise }: Wanted, dtMs: number): TipState | null {
  const { robot, isLocked: locked } = arm;
  const tip = added(from.tip, scaled(by, share));
  const tiltM = rise === null ? 0 : Math.abs(rise - poseOfLimb(from.leading).pointing[2]) * RISE_M;
  const mode = { how: 'follow', askedM: lengthOf(by) + tiltM } as const;
  const wish = { tip, rise, mode, isLocked: locked };
  const { leading, targets } = leadTo(from.leading, robot, wish);
  const pose = poseOfLimb(leading);
  const isOnLine = lengthOf(minus(pose.tip, tip)) <= OFF_LINE_M;
  const isAsWanted = rise === null || Math.abs(pose.pointing[2] - rise) <= LEVEL / 2;
  if (!isOnLine || !isAsWanted || isTooFast(arm, from.leading, leading, dtMs)) return null;
  const others = from.sent.filter((one) => !targets.some(({ servo }) => servo === one.servo));
  return { leading, tip, sent: [...targets, ...others] };
}

function isTooFast({ robot, unitsPerS }: Arm, from: Leading, to: Leading, dtMs: number): boolean {
  return to.limb.servos.some((number, index) => {
    const servo = servoOf(robot, number);
    if (servo === undefined) return false;
    const most = (Math.abs(radiansOf(servo, servo.home + unitsPerS)) * dtMs) / 1000;
    return Math.abs((to.angles[index] ?? 0) - (from.angles[index] ?? 0)) > most;
  });
}

function createTipDriver(stores: Stores, robot: Robot, limb: LedLimb): TipDriver {
  const { device, mappings } = stores;
  let state: TipState | null = null;
  return {
    ...{ robot, tip: limb.tip, servos: limb.servos },
    step(speed, dtMs) {
      const { min, max } = device.store.getState().family.position;
      const moment = tipStep(
        {
          ...{ limb, robot, place: device.motions(), unitsPerS: ((max - min) * 1000) / RANGE_MS },
          isLevel: mappings.store.getState().present.tip?.isLevel === true,
          isLocked: (servo) => isLocked(stores, servo),
        },
        ...([speed, dtMs, state] as const),
      );
      state = moment.state;
      return moment;
    },
  };
}

export function TipControls() {
  const stores = useStores();
  const { pad, mappings } = stores;
  const robot = useRobot();
  const { tip } = useMapping();
  const isShort = usePad(({ limb: led }) => led?.isShort === true);
  const { description, state } = useModel(robot);
  const limbs = useMemo(() => {
    const servos = robot.servos.map(({ servo }) => servo);
    return description === null ? [] : limbsOfModel(parseUrdf(description), servos);
  }, [description, robot]);
  const limb = limbs.find((one) => one.tip === tip?.limb) ?? limbs[0];
  useEffect(
    () => pad.lead(limb === undefined ? null : createTipDriver(stores, robot, limb)),
    [pad, stores, robot, limb],
  );

  const choose = (step: 'limb' | 'level', chosen: Partial<TipChoice>): void =>
    mappings.edit(
      () => words.pad.steps[step],
      (mapping) => (mapping.tip ? { ...mapping, tip: { ...mapping.tip, ...chosen } } : mapping),
    );
  if (limb === undefined) return state === 'loading' ? null : <p>{words.pad.noTip}</p>;
  return (
    <>
      {limbs.length > 1 && (
        <Select
          label={words.pad.limb}
          value={limb.tip}
          options={limbs.map((one) => ({ value: one.tip, label: nameOf(one, robot) }))}
          onChange={(chosen) => choose('limb', { limb: chosen })}
        />
      )}
      <Toggle
        label={words.pad.tipLevel}
        isOn={tip?.isLevel === true}
        onChange={(isLevel) => choose('level', { isLevel })}
      />
      <p className={styles.short} role="status">
        {isShort && words.pad.short}
      </p>
    </>
  );
}
