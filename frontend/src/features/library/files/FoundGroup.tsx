// A group in an opened file: its plot and size, the question for its unit if the file has none, and what does not fit. Imported as it
// is, or converted on request.

import { useMemo } from 'react';
import { type Unit, meaningIn, UNIT_RANGE } from '#shared/files/reading.ts';
import { type ActionGroup, totalDurationMs, poseAt } from '#shared/group/group.ts';
import { flattened } from '#shared/group/flattened.ts';
import { filled, misfitsOf } from '#shared/files/fit.ts';
import { meaningText, misfitText } from './fileText.ts';
import { words } from '../../../i18n/whole.ts';
import { GroupThumb } from '../../picture/PoseThumb.tsx';
import { boardOfGroup } from '../../groupDocument.ts';
import { useKnownFamily, useRobot } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Toggle } from '../../../ui/Toggle.tsx';
import { convertedOf, takenAs, type Answer } from './answers.ts';
import styles from './FoundGroup.module.css';

const UNITS: readonly Unit[] = ['us', 'steps'];

interface UnitQuestionProps {
  readonly group: ActionGroup;
  readonly unit: Unit | null;
  onUnit(unit: Unit): void;
}

function UnitQuestion({ group, unit, onUnit }: UnitQuestionProps) {
  return (
    <div role="group" aria-label={words.files.askUnit}>
      <p className={styles.question}>{words.files.askUnit}</p>
      <div className={styles.answers}>
        {UNITS.map((one) => (
          <button
            key={one}
            type="button"
            className={styles.answer}
            aria-pressed={unit === one}
            onClick={() => onUnit(one)}
          >
            <span>{words.files.units[one]}</span>
            <span className={styles.meaning}>{meaningText(one, meaningIn(one, group))}</span>
          </button>
        ))}
      </div>
    </div>
  );
}

const WIDTH = 100;
const HEIGHT = 40;
/** A small picture shows no more than this. */
const SHOWN_FRAMES = 300;
const SHOWN_SERVOS = 32;

function GroupPlot({ group }: { readonly group: ActionGroup }) {
  return (
    <svg
      className={styles.plot}
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      aria-hidden="true"
    >
      {linesOf(group).map((points) => (
        <polyline key={points} points={points} className={styles.line} />
      ))}
    </svg>
  );
}

function linesOf(group: ActionGroup): readonly string[] {
  const { frames } = filled({ ...group, frames: group.frames.slice(0, SHOWN_FRAMES) });
  const lengthMs = Math.max(1, totalDurationMs(frames.slice(1)));
  const { min, max } = UNIT_RANGE[group.unit];
  const lines = new Map<number, string[]>();
  let atMs = 0;
  frames.forEach(({ durationMs, targets }, index) => {
    if (index > 0) atMs += durationMs;
    for (const { servo, position } of targets) {
      const share = Math.min(1, Math.max(0, (position - min) / (max - min)));
      const point = `${((atMs / lengthMs) * WIDTH).toFixed(1)},${((1 - share) * HEIGHT).toFixed(1)}`;
      const line = lines.get(servo);
      if (line === undefined) lines.set(servo, [point]);
      else line.push(point);
    }
  });
  return [...new Set([...lines.values()].slice(0, SHOWN_SERVOS).map((points) => points.join(' ')))];
}

interface FoundGroupProps {
  readonly found: ActionGroup;
  readonly isUnitMissing: boolean;
  readonly answer: Answer;
  onAnswer(change: Partial<Answer>): void;
  onTake(group: ActionGroup): void;
}

export function FoundGroup({ found, isUnitMissing, answer, onAnswer, onTake }: FoundGroupProps) {
  const family = useKnownFamily();
  const robot = useRobot();
  const { unit, converts } = answer;
  const group = takenAs(found, answer, family.unit);
  const shown = useMemo(() => flattened(group), [group]);
  const { frames } = shown;
  return (
    <div className={styles.group}>
      <div className={styles.row}>
        <span className={styles.thumb}>
          <GroupThumb
            {...boardOfGroup(group, family, robot)}
            pose={poseAt(frames, Math.floor(frames.length / 2))}
            changed={[]}
          />
        </span>
        <GroupPlot group={shown} />
        <div className={styles.words}>
          <p className={styles.name}>{group.name}</p>
          <p className={styles.dim}>{aboutOf(shown)}</p>
        </div>
        <Button
          tone="primary"
          aria-label={words.files.take({ name: group.name })}
          isDisabled={unit === null}
          onPress={() => onTake(group)}
        >
          {words.files.takeVerb}
        </Button>
      </div>
      {isUnitMissing && <UnitQuestion group={found} unit={unit} onUnit={(one) => onAnswer({ unit: one })} />}
      {unit !== null && convertedOf(found, answer, family.unit) !== null && (
        <Toggle
          label={words.files.convert({ to: family.unit })}
          isOn={converts}
          onChange={(isOn) => onAnswer({ converts: isOn })}
        />
      )}
      {unit !== null && <Misfits group={shown} />}
    </div>
  );
}

function aboutOf({ frames, slot }: ActionGroup): string {
  const servos = new Set(frames.flatMap(({ targets }) => targets.map(({ servo }) => servo)));
  const about = words.files.about({
    frames: frames.length,
    durationMs: totalDurationMs(frames),
    servos: servos.size,
  });
  return slot === null ? about : `${about}, ${words.files.slot({ slot })}`;
}

function Misfits({ group }: { readonly group: ActionGroup }) {
  const family = useKnownFamily();
  const robot = useRobot();
  const misfits = useMemo(() => misfitsOf(group, family, robot), [group, family, robot]);
  if (misfits.length === 0) return null;
  return (
    <div className={styles.misfits}>
      <p>{words.files.misfits}</p>
      <ul>
        {misfits.map((misfit) => (
          <li key={`${misfit.code} ${misfit.servo}`}>{misfitText(misfit)}</li>
        ))}
      </ul>
    </div>
  );
}
