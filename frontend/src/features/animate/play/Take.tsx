// What was recorded, before it becomes keys: how many of them a chosen error leaves, and whether they are a new group or go to the end
// of the one at hand.

import { useMemo, useState } from 'react';
import type { ActionGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { simplify, type Sample } from '#shared/group/simplify.ts';
import { GENTLE_MOVE_MS } from '../../../robot/moves.ts';
import { useDevice, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { NumberField } from '../../../ui/NumberField.tsx';
import { words } from '../../../i18n/whole.ts';
import field from '../../../ui/Field.module.css';
import styles from './Take.module.css';

export interface TakeProps {
  readonly samples: readonly Sample[];
  onClose(): void;
}

/** An error that is not seen in a motion by hand. */
const USUAL_ERROR = { us: 10, steps: 4 } as const;
const MOST_ERROR = 200;

export function Take({ samples, onClose }: TakeProps) {
  const { document, notices, playhead, view } = useStores();
  const unit = useDevice((state) => state.family.unit);
  const [maxErrorUnits, setMaxError] = useState<number>(USUAL_ERROR[unit]);
  const group = useMemo(
    () => simplify(samples, { name: '', unit, maxErrorUnits, leadMs: GENTLE_MOVE_MS }),
    [samples, unit, maxErrorUnits],
  );
  const keyCount = group.frames.reduce((sum, { targets }) => sum + targets.length, 0);
  const use = (step: keyof typeof words.record.steps, edit: (before: ActionGroup) => ActionGroup): void => {
    document.edit(() => words.record.steps[step], edit);
    view.setState({ selectedFrame: null, tab: 'actions', authoring: 'group' });
    playhead.show(0);
    onClose();
  };
  return (
    <div className={styles.take}>
      <div className={field.named}>
        <span aria-hidden="true">{words.record.error}</span>
        <NumberField
          label={words.record.errorField}
          value={maxErrorUnits}
          min={1}
          max={MOST_ERROR}
          unit={words.units[unit]}
          onChange={setMaxError}
          onRefused={(value) =>
            notices.refuse(words.refused({ name: words.record.errorField, value, min: 1, max: MOST_ERROR }))
          }
        />
      </div>
      <p role="status">
        {words.record.result({ ms: lengthOf(samples), samples: samples.length, keys: keyCount })}
      </p>
      <div className={styles.verbs}>
        <Button onPress={() => use('append', (before) => appended(before, group))}>
          {words.record.append}
        </Button>
        <Button tone="primary" onPress={() => use('replace', () => named(group))}>
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

/** Behind a gentle way from where the group ends; an empty one takes the unit. */
function appended(before: ActionGroup, { frames, unit }: ActionGroup): ActionGroup {
  if (before.frames.length > 0 && before.unit !== unit) return before;
  return frames.reduce((sum, frame) => insertFrame(sum, sum.frames.length, frame, unit), before);
}
