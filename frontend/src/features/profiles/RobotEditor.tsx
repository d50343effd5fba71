// The editor of the current robot: its name, body, battery, servos and their places.

import { useId, useRef } from 'react';
import { fedBy } from '#shared/profile/battery.ts';
import { BATTERY_KINDS, BODIES, NAME_LENGTH } from '#shared/profile/robot.ts';
import { addServo } from '#shared/profile/robotEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { ArrangedPlace } from '../picture/ArrangedPlace.tsx';
import { useRobot, useStores } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { RobotPicture, RobotHead } from './RobotPicture.tsx';
import { Button } from '../../ui/Button.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { Select } from '../../ui/Select.tsx';
import { boardName } from '../../i18n/sentences.ts';
import { CellField, ServoTable } from './ServoTable.tsx';
import styles from './RobotEditor.module.css';

/** With three.js, so fetched only where an editor is open. */
const ModelEditor = laterComponent(
  async () => (await import('./ModelEditor.tsx')).ModelEditor,
  '160px',
  'onDemand',
);

/** The places of the servos on the drawing of the body, by drag or arrow keys. Moves nothing. */
function PlaceEditor() {
  const robot = useRobot();
  const stage = useRef<HTMLDivElement>(null);
  const headingId = useId();
  return (
    <section className={styles.editor} aria-labelledby={headingId}>
      <div className={styles.words}>
        <h3 id={headingId}>{words.robotEditor.places}</h3>
        <p>{words.robotEditor.placesHint}</p>
      </div>
      <div ref={stage} className={styles.stage}>
        <RobotPicture robot={robot} />
        <ul aria-label={words.robotEditor.places}>
          {robot.servos.map((servo) => (
            <ArrangedPlace key={servo.servo} servo={servo} stage={stage} />
          ))}
        </ul>
      </div>
    </section>
  );
}

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
        <Kind
          label={words.robotEditor.body}
          value={robot.body}
          kinds={BODIES}
          names={words.robotEditor.bodies}
          onChange={(body) =>
            robots.edit(
              () => words.robotEditor.body,
              (all) => ({ ...all, body }),
            )
          }
        />
        <Kind
          label={words.robotEditor.battery}
          value={robot.battery}
          kinds={BATTERY_KINDS}
          names={words.robotEditor.batteries}
          onChange={(kind) =>
            robots.edit(
              () => words.robotEditor.battery,
              (all) => fedBy(all, kind),
            )
          }
        />
        <p className={styles.dim}>{words.robotEditor.board({ name: boardName(FAMILIES[robot.board]) })}</p>
      </div>
      <ServoTable />
      <AddServo />
      <PlaceEditor />
      <ModelEditor />
    </>
  );
}

interface KindProps<Value extends string> {
  readonly label: string;
  readonly value: Value;
  readonly kinds: readonly Value[];
  readonly names: Readonly<Record<Value, string>>;
  onChange(kind: Value): void;
}

function Kind<Value extends string>({ label, value, kinds, names, onChange }: KindProps<Value>) {
  return (
    <label>
      <span>{label}</span>
      <Select
        label={label}
        value={value}
        options={kinds.map((kind) => ({ value: kind, label: names[kind] }))}
        onChange={onChange}
      />
    </label>
  );
}

function AddServo() {
  const { robots } = useStores();
  const robot = useRobot();
  const longer = addServo(robot, (number) => words.robotEditor.newServo({ servo: number }));
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
