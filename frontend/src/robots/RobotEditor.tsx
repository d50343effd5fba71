// The description of the robot at hand: its name, what feeds it, its servos.

import { fedBy } from '#shared/actions/battery/batterySupply.ts';
import { BATTERY_KINDS, NAME_LENGTH, type BatteryKind } from '#shared/actions/robot/robot.ts';
import { addServo } from '#shared/actions/robot/robotEdits.ts';
import { FAMILIES } from '#shared/protocol/families.ts';
import { useRobot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';
import { CellField } from './CellField.tsx';
import { PlaceEditor } from './PlaceEditor.tsx';
import { RobotHead } from './RobotHead.tsx';
import { ServoTable } from './ServoTable.tsx';
import styles from './RobotEditor.module.css';

export function RobotEditor() {
  const { robots } = useStores();
  const robot = useRobot();

  function rename(text: string): boolean {
    const wanted = text.trim();
    return (
      wanted !== '' &&
      robots.edit(
        () => words.robotEditor.name,
        (all) => ({ ...all, name: wanted }),
      )
    );
  }

  return (
    <>
      <RobotHead />
      <div className={styles.facts}>
        <label className={styles.name}>
          <span>{words.robotEditor.name}</span>
          <CellField
            label={words.robotEditor.name}
            value={robot.name}
            maxLength={NAME_LENGTH}
            onTake={rename}
          />
        </label>
        <label>
          <span>{words.robotEditor.battery}</span>
          <select
            className={styles.select}
            value={robot.battery}
            onChange={({ target: { value } }) =>
              robots.edit(
                () => words.robotEditor.battery,
                (all) => fedBy(all, value as BatteryKind),
              )
            }
          >
            {BATTERY_KINDS.map((kind) => (
              <option key={kind} value={kind}>
                {words.robotEditor.batteries[kind]}
              </option>
            ))}
          </select>
        </label>
        <p className={styles.dim}>{words.robotEditor.board(words.boardName(FAMILIES[robot.board]))}</p>
      </div>
      <ServoTable />
      <AddServo />
      <PlaceEditor />
    </>
  );
}

function AddServo() {
  const { robots } = useStores();
  const robot = useRobot();
  const longer = addServo(robot, words.robotEditor.newServo);
  return (
    <div className={styles.foot}>
      <Button
        icon="plus"
        isDisabled={longer === null}
        onPress={() =>
          longer !== null &&
          robots.edit(
            () => words.robotEditor.addStep,
            () => longer,
          )
        }
      >
        {words.robotEditor.add}
      </Button>
      <p className={styles.dim}>{longer === null ? words.robotEditor.full : words.robotEditor.hint}</p>
    </div>
  );
}
