// The imported model of the current robot: its file, which servo turns which of its joints, and the link that can be dragged. What
// is changed here is one step of undo each; nothing moves.

import { useId, useState } from 'react';
import type { Label } from '#shared/document/history.ts';
import type { Robot, RobotModel, RobotJoint } from '#shared/profile/robot.ts';
import { changeServo, turnJoint, turnJoints, withoutJoint } from '#shared/profile/robotEdits.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { words } from '../../i18n/whole.ts';
import { Button } from '../../ui/Button.tsx';
import { storeFile } from '../../state/fileStore.ts';
import { FileButton } from '../../ui/localFiles.tsx';
import { Select } from '../../ui/Select.tsx';
import {
  type ModelFile,
  jointsOf,
  linksOf,
  ModelFileError,
  readModelFile,
  trianglesOf,
} from '../picture/three/modelFile.ts';
import { ModelPreview } from '../picture/three/ModelPreview.tsx';
import { describe, useModelFile } from '../picture/three/useModel.ts';
import { useRobot, useStores } from '../stores.ts';
import { CellField } from './ServoTable.tsx';
import editor from './RobotEditor.module.css';
import styles from './ModelEditor.module.css';

const KINDS = '.urdf,.xml,.zip';

export function ModelEditor() {
  const { robots } = useStores();
  const robot = useRobot();
  const headingId = useId();
  const { model } = robot;
  const file = useModelFile(model?.id ?? null);
  const [problem, setProblem] = useState<string | null>(null);

  async function take(chosen: File): Promise<void> {
    setProblem(
      await imported(chosen, robot, (next) =>
        robots.edit(
          () => words.robotModel.importStep,
          () => next,
        ),
      ),
    );
  }

  return (
    <section className={editor.editor} aria-labelledby={headingId}>
      <div className={styles.words}>
        <h3 id={headingId}>{words.robotModel.title}</h3>
        <p>{words.robotModel.hint}</p>
        <div className={styles.tools}>
          <FileButton accept={KINDS} onChoose={([chosen]) => chosen && void take(chosen)}>
            {model === undefined ? words.robotModel.choose : words.robotModel.replace}
          </FileButton>
          {model !== undefined && (
            <Button
              tone="quiet"
              icon="trash"
              onPress={() => robots.edit(() => words.robotModel.removeStep, withoutModel)}
            >
              {words.robotModel.remove}
            </Button>
          )}
        </div>
        <p className={styles.problem} role="alert">
          {problem}
        </p>
      </div>
      {model !== undefined && file === null && <p>{words.robotModel.elsewhere({ file: model.fileName })}</p>}
      {model !== undefined && file && <Joints {...{ robot, model, file }} />}
    </section>
  );
}

function withoutModel({ model: _, ...robot }: Robot): Robot {
  return { ...robot, servos: robot.servos.map(withoutJoint) };
}

/** Says why not, or null. */
async function imported(chosen: File, robot: Robot, take: (next: Robot) => boolean): Promise<string | null> {
  const { flaws } = words.robotModel;
  let bytes: Uint8Array;
  let names: readonly string[];
  let end: string | null;
  try {
    bytes = new Uint8Array(await chosen.arrayBuffer());
    const file = readModelFile(bytes);
    if (describe(file, robot) === null) return flaws.broken;
    names = jointsOf(file.urdf).map(({ name }) => name);
    end = endOf(file.urdf, names);
  } catch (error) {
    return error instanceof ModelFileError ? flaws[error.flaw] : flaws.broken;
  }
  try {
    const id = await storeFile(bytes);
    take({ ...turnJoints(robot, names), model: { id, fileName: chosen.name, end } });
    return null;
  } catch {
    return flaws.notStored;
  }
}

/** The link behind the last joint of the longest row of joints: where a gripper is, usually. */
function endOf(urdf: Document, names: readonly string[]): string | null {
  const last = names.at(-1);
  const joint = [...urdf.querySelectorAll('robot > joint')].find((one) => one.getAttribute('name') === last);
  return joint?.querySelector(':scope > child')?.getAttribute('link') ?? null;
}

interface JointsProps {
  readonly robot: Robot;
  readonly model: RobotModel;
  readonly file: ModelFile;
}

function Joints({ robot, model, file }: JointsProps) {
  const { robots } = useStores();
  const [turned, setTurned] = useState<{ readonly servo: number; readonly degrees: number } | null>(null);
  const joints = jointsOf(file.urdf);
  const missing = [...file.meshes].filter(([, mesh]) => mesh === null).map(([name]) => name);
  return (
    <div className={styles.model}>
      <ModelPreview {...{ robot, file, turned }} />
      <div className={styles.facts}>
        <p>
          {words.robotModel.about({
            ...{ file: model.fileName, joints: joints.length, triangles: trianglesOf(file) },
          })}
        </p>
        {missing.length > 0 && (
          <p className={styles.problem}>{words.robotModel.missing({ names: missing.join(words.comma) })}</p>
        )}
        <ol className={styles.joints} aria-label={words.robotModel.joints}>
          {joints.map(({ name }) => (
            <JointLine
              key={name}
              {...{ name, robot }}
              onTurn={(servo, degrees) => setTurned(degrees === 0 ? null : { servo, degrees })}
            />
          ))}
        </ol>
        <label className={styles.end}>
          <span>{words.robotModel.end}</span>
          <Select
            label={words.robotModel.end}
            value={model.end ?? ''}
            options={[
              { value: '', label: words.robotModel.noEnd },
              ...linksOf(file.urdf).map((link) => ({ value: link, label: link })),
            ]}
            onChange={(end) =>
              robots.edit(
                () => words.robotModel.endStep,
                (all) => ({ ...all, model: { ...model, end: end === '' ? null : end } }),
              )
            }
          />
        </label>
      </div>
    </div>
  );
}

interface JointLineProps {
  readonly name: string;
  readonly robot: Robot;
  /** In the picture. */
  onTurn(servo: number, degrees: number): void;
}

const MOST_DEGREES = 60;

function JointLine({ name, robot, onTurn }: JointLineProps) {
  const { robots } = useStores();
  const servo = robot.servos.find((one) => one.joint?.name === name);
  const joint = servo?.joint;
  const [degrees, setDegrees] = useState(0);
  const cell = (column: string): string => words.robotModel.cell({ column, joint: name });
  const edit = (column: Label, change: (all: Robot) => Robot): boolean =>
    robots.edit(() => words.robotModel.jointStep({ column: column(), joint: name }), change);
  const change = (column: Label, part: Partial<RobotJoint>): boolean =>
    servo !== undefined &&
    joint !== undefined &&
    edit(column, (all) => changeServo(all, servo.servo, { joint: { ...joint, ...part } }));

  function turn(to: number): void {
    setDegrees(to);
    if (servo !== undefined) onTurn(servo.servo, to);
  }

  return (
    <li className={styles.joint} aria-label={name}>
      <span className={styles.name}>{name}</span>
      <Select
        label={cell(words.robotModel.servo)}
        value={servo === undefined ? '' : String(servo.servo)}
        options={[
          { value: '', label: words.robotModel.none },
          ...robot.servos.map((one) => ({
            value: String(one.servo),
            label: words.robotEditor.row({ servo: one.servo, name: servoLabel(one) }),
          })),
        ]}
        onChange={(chosen) =>
          edit(
            () => words.robotModel.servo,
            (all) => turnJoint(all, name, chosen === '' ? null : Number(chosen)),
          )
        }
      />
      {joint !== undefined && (
        <>
          <label className={styles.check}>
            <input
              type="checkbox"
              checked={joint.isReversed}
              aria-label={cell(words.robotModel.reversed)}
              onChange={({ target }) =>
                change(() => words.robotModel.reversed, { isReversed: target.checked })
              }
            />
            {words.robotModel.reversed}
          </label>
          <label className={styles.degrees}>
            <span>{words.robotModel.homeDegrees}</span>
            <CellField
              label={cell(words.robotModel.homeDegrees)}
              value={String(joint.homeDegrees)}
              isNumber
              column="homeDegrees"
              onTake={(text) => {
                const homeDegrees = Number(text.replace(',', '.'));
                return text.trim() !== '' && change(() => words.robotModel.homeDegrees, { homeDegrees });
              }}
            />
          </label>
          <input
            type="range"
            className={styles.turn}
            aria-label={words.robotModel.turn({ joint: name })}
            min={-MOST_DEGREES}
            max={MOST_DEGREES}
            value={degrees}
            onChange={({ target }) => turn(target.valueAsNumber)}
            onBlur={() => turn(0)}
          />
        </>
      )}
    </li>
  );
}
