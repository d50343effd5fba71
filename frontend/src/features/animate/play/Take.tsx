// What was recorded, before it becomes keys: the part of it that is taken, which servos, how many keys a chosen error leaves, and where
// they go: a new group, the end of the open one, or the playhead.

import { type CSSProperties, useMemo, useState } from 'react';
import type { ActionGroup } from '#shared/group/group.ts';
import { simplify, type Sample } from '#shared/group/simplify.ts';
import { type Robot, servoOf } from '#shared/profile/robot.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { recorded } from '../../servoView.ts';
import { useDevice, useHoldsMotion, useRobot, useServoView, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { Toggle } from '../../../ui/Toggle.tsx';
import { words } from '../../../i18n/whole.ts';
import { appended, inserted, keyCountOf, over, USUAL_ERROR } from './recordOver.ts';
import field from '../../../ui/Field.module.css';
import styles from './Take.module.css';

export interface TakeProps {
  readonly samples: readonly Sample[];
  onClose(): void;
}

const MOST_ERROR = 200;

export function Take({ samples, onClose }: TakeProps) {
  const { document, playhead, view } = useStores();
  const unit = useDevice((state) => state.family.unit);
  const isEmpty = !useHoldsMotion();
  const robot = useRobot();
  const armed = recorded(
    useServoView((all) => all),
    robot.servos.map(({ servo }) => servo),
  );
  const [onlyArmed, setOnlyArmed] = useState(armed.by === 'armed');
  const [maxErrorUnits, setMaxError] = useState<number>(USUAL_ERROR[unit]);
  const [part, setPart] = useState<Part>(() => ({ fromMs: 0, toMs: lengthOf(samples) }));
  const own = useMemo(
    () => (onlyArmed ? samples.filter(({ servo }) => armed.servos.includes(servo)) : samples),
    [samples, onlyArmed, armed.servos],
  );
  const beganMs = samples[0]?.atMs ?? 0;
  const taken = useMemo(() => trimmed(own, beganMs, part), [own, beganMs, part]);
  const group = useMemo(
    () => simplify(taken, { name: '', unit, maxErrorUnits, leadMs: GENTLE_MOVE_MS }),
    [taken, unit, maxErrorUnits],
  );
  const keyCount = keyCountOf(group);
  const use = (step: keyof typeof words.record.steps, edit: (before: ActionGroup) => ActionGroup): void => {
    document.edit(() => words.record.steps[step], edit);
    view.setState({ selectedFrame: null, tab: 'actions', authoring: 'group' });
    if (step === 'replace') playhead.show(0);
    onClose();
  };
  return (
    <div className={styles.take}>
      <Strip {...{ samples: own, robot, part, beganMs, lengthMs: lengthOf(samples) }} onChange={setPart} />
      {armed.by !== 'all' && (
        <Toggle label={words.record.onlyArmed[armed.by]} isOn={onlyArmed} onChange={setOnlyArmed} />
      )}
      <div className={field.named}>
        <span aria-hidden="true">{words.record.error}</span>
        <CheckedNumber
          label={words.record.errorField}
          value={maxErrorUnits}
          min={1}
          max={MOST_ERROR}
          unit={words.units[unit]}
          onChange={setMaxError}
        />
      </div>
      <p role="status">
        {words.record.result({ ms: lengthOf(taken), samples: taken.length, keys: keyCount })}
      </p>
      <div className={styles.verbs}>
        {!isEmpty && (
          <>
            <Button
              hint={words.record.overHint}
              onPress={() => use('over', (before) => over(before, group, playhead.at()))}
            >
              {words.record.over}
            </Button>
            <Button onPress={() => use('insert', (before) => inserted(before, group, playhead.at()))}>
              {words.record.insert}
            </Button>
            <Button onPress={() => use('append', (before) => appended(before, group))}>
              {words.record.append}
            </Button>
          </>
        )}
        <Button tone="primary" isDisabled={keyCount === 0} onPress={() => use('replace', () => named(group))}>
          {words.record.replace}
        </Button>
      </div>
    </div>
  );
}

const named = (group: ActionGroup): ActionGroup => ({
  ...group,
  name: words.record.name({ time: words.dates.formatTimeOfDay(Date.now()) }),
});

function lengthOf(samples: readonly Sample[]): number {
  return (samples.at(-1)?.atMs ?? 0) - (samples[0]?.atMs ?? 0);
}

/** Since the recording began. */
interface Part {
  readonly fromMs: number;
  readonly toMs: number;
}

const trimmed = (samples: readonly Sample[], beganMs: number, { fromMs, toMs }: Part): readonly Sample[] =>
  samples.filter(({ atMs }) => atMs - beganMs >= fromMs && atMs - beganMs <= toMs);

interface StripProps {
  readonly samples: readonly Sample[];
  readonly robot: Robot;
  readonly part: Part;
  readonly beganMs: number;
  readonly lengthMs: number;
  onChange(part: Part): void;
}

const STEP_MS = 40;
const SHORTEST_MS = 200;
const HEIGHT = 100;
const WIDTH = 1000;

/** The whole recording, a line for each servo, with a handle at each end of what is taken. */
function Strip({ samples, robot, part, beganMs, lengthMs, onChange }: StripProps) {
  const lines = useMemo(
    () => linesOf(samples, robot, { beganMs, lengthMs }),
    [samples, robot, beganMs, lengthMs],
  );
  const share = (atMs: number): number => atMs / Math.max(1, lengthMs);
  const handle = (end: keyof Part, change: (atMs: number) => Part) => (
    <input
      type="range"
      className={styles.handle}
      aria-label={words.record[end === 'fromMs' ? 'begin' : 'finish']}
      aria-valuetext={words.record.at({ ms: part[end] })}
      min={0}
      max={lengthMs}
      step={STEP_MS}
      value={part[end]}
      onChange={({ target }) => onChange(change(target.valueAsNumber))}
    />
  );
  return (
    <div
      className={styles.strip}
      role="group"
      aria-label={words.record.part}
      style={{ '--from': share(part.fromMs), '--to': share(part.toMs) } as CSSProperties}
    >
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} preserveAspectRatio="none" aria-hidden="true">
        {lines.map(({ servo, path }) => (
          <path key={servo} d={path} />
        ))}
      </svg>
      {handle('fromMs', (atMs) => ({ ...part, fromMs: Math.min(atMs, part.toMs - SHORTEST_MS) }))}
      {handle('toMs', (atMs) => ({ ...part, toMs: Math.max(atMs, part.fromMs + SHORTEST_MS) }))}
    </div>
  );
}

interface Line {
  readonly servo: number;
  readonly path: string;
}

/** Each servo's way within its own limits. */
function linesOf(
  samples: readonly Sample[],
  robot: Robot,
  { beganMs, lengthMs }: Pick<StripProps, 'beganMs' | 'lengthMs'>,
): readonly Line[] {
  const points = new Map<number, string[]>();
  for (const { servo, atMs, position } of samples) {
    const { min, max } = servoOf(robot, servo) ?? { min: position - 1, max: position + 1 };
    const x = ((atMs - beganMs) / Math.max(1, lengthMs)) * WIDTH;
    const y = (1 - (position - min) / (max - min)) * HEIGHT;
    const own = points.get(servo);
    const point = `${x.toFixed(1)} ${y.toFixed(1)}`;
    if (own === undefined) points.set(servo, [point]);
    else own.push(point);
  }
  return [...points].map(([servo, all]) => ({ servo, path: `M${all.join('L')}` }));
}
