// A group as it stands in a file: its picture and measures, the unit asked where nobody said, what does not fit. It is taken
// over as it is, or converted where the person says so.

import { useMemo } from 'react';
import { misfitsOf } from '#shared/files/fit.ts';
import { poseAt, totalDurationMs, type ActionGroup } from '#shared/group/group.ts';
import { GroupThumb } from '../../picture/PoseThumb.tsx';
import { boardOfGroup } from '../../animate/group/groupBoard.ts';
import { useKnownFamily, useRobot } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Toggle } from '../../../ui/Toggle.tsx';
import { misfitText } from './fileText.ts';
import { words } from '../../../i18n/whole.ts';
import { convertedOf, takenAs, type Answer } from './answers.ts';
import { GroupPlot } from './GroupPlot.tsx';
import { UnitQuestion } from './UnitQuestion.tsx';
import styles from './FoundGroup.module.css';

export interface FoundGroupProps {
  readonly found: ActionGroup;
  readonly asksUnit: boolean;
  readonly answer: Answer;
  onAnswer(change: Partial<Answer>): void;
  onTake(group: ActionGroup): void;
}

export function FoundGroup({ found, asksUnit, answer, onAnswer, onTake }: FoundGroupProps) {
  const family = useKnownFamily();
  const robot = useRobot();
  const { unit, converts } = answer;
  const group = takenAs(found, answer, family.unit);
  const { frames } = group;
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
        <GroupPlot group={group} />
        <div className={styles.words}>
          <p className={styles.name}>{group.name}</p>
          <p className={styles.dim}>{aboutOf(group)}</p>
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
      {asksUnit && <UnitQuestion group={found} unit={unit} onUnit={(one) => onAnswer({ unit: one })} />}
      {unit !== null && convertedOf(found, answer, family.unit) !== null && (
        <Toggle
          label={words.files.convert({ to: family.unit })}
          isOn={converts}
          onChange={(isOn) => onAnswer({ converts: isOn })}
        />
      )}
      {unit !== null && <Misfits group={group} />}
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
