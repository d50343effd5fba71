// The panel of poses: cards, tools for the selected pose, and at its foot capturing a pose, moving home or to rest, and files of poses. The
// robot moves only by buttons that say so.

import { useRef, useState, type MouseEvent } from 'react';
import { type Pose, setPose, poseBookToText, POSE_VERBS } from '#shared/profile/pose.ts';
import { unknownServos } from '#shared/profile/poseShapes.ts';
import type { RobotServo } from '#shared/profile/robot.ts';
import { useDevice, useRobot, usePoses, useStores, useView, useSnapshot } from '../stores.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import { EmptyState, type PanelParts } from '../../ui/Panel.tsx';
import { words } from '../../i18n/whole.ts';
import { runByKey } from '../../ui/action.ts';
import { useCards } from '../../ui/cards.ts';
import { POSE_ACTIONS } from './poseActions.ts';
import { PoseCard, useNaming, useSelectedPose, type Captured } from './PoseCard.tsx';
import { limbsOf } from '../picture/pose.ts';
import { UndoTools } from '../undo/UndoTools.tsx';
import { BlendBar } from './BlendBar.tsx';
import { PoseTools, type Drawer } from './PoseTools.tsx';
import styles from './PosesPanel.module.css';
import { saveFile } from '../../ui/localFiles.tsx';
import { IconButton, Button, isByKey } from '../../ui/Button.tsx';
import { CaptureButton } from '../animate/frames/CaptureButton.tsx';
import { poseName } from './poses.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { CheckedNumber } from '../CheckedNumber.tsx';

/** Shown without poses: what some would look like on the current robot. */
function EmptyPoses() {
  return <EmptyState title={words.poses.empty} hint={words.poses.emptyHint} sketch={<Sketch />} />;
}

/** The sketches' distances from home, as fractions of the way to the limit. */
const SHARES = [-0.4, 0, 0.4];

function Sketch() {
  const { servos } = useRobot();
  const family = useDevice((state) => state.family);
  return (
    <div className={styles.sketch} aria-hidden="true">
      {SHARES.map((share) => (
        <span key={share} className={styles.card}>
          <PoseThumb
            pose={new Map(servos.map((one) => [one.servo, turned(one, share)]))}
            changed={[]}
            family={family}
          />
        </span>
      ))}
    </div>
  );
}

function turned({ home, min, max }: Record<'home' | 'min' | 'max', number>, share: number): number {
  return Math.round(home + share * (share < 0 ? home - min : max - home));
}

function PoseList() {
  const stores = useStores();
  const book = usePoses(({ present }) => present);
  const selected = useView((state) => state.selectedPose);
  const { list, tabStop, key } = useCards<HTMLOListElement>({
    ...{ ids: book.poses.map(({ id }) => id), selected, attribute: 'data-pose' },
    select: (id) => stores.view.setState({ selectedPose: id }),
    act: (pressed, id) => runByKey(Object.values(POSE_ACTIONS), pressed, { stores, id }),
  });

  const marks = ({ id }: Pose): string =>
    [
      book.restId === id ? words.poses.resting : '',
      book.applied === id || (book.applied === 'rest' && book.restId === id) ? words.poses.applied : '',
    ]
      .filter((mark) => mark !== '')
      .join(words.comma);

  return (
    <ol ref={list} className={styles.list} aria-label={words.poses.list} onKeyDown={key}>
      {book.poses.map((pose) => (
        <PoseCard
          key={pose.id}
          pose={pose}
          marks={marks(pose)}
          isSelected={pose.id === selected}
          isTabStop={pose.id === tabStop}
        />
      ))}
    </ol>
  );
}

/** Chooses the servos of a pose. A servo that is added gets its current target; servos that are not in the pose do not move. */
function ServoPicker({ pose }: { readonly pose: Pose }) {
  const { device, poses } = useStores();
  const robot = useRobot();
  const { servos } = robot;
  const known = useDevice((state) => state.known);
  const sameUnit = useDevice((state) => state.family.unit === pose.unit);
  const included = new Set(pose.targets.map(({ servo }) => servo));
  /** Servos from a file that this robot lacks; they can be removed. */
  const unknown = unknownServos(robot, pose.targets);

  function choose(servo: number, isIn: boolean): void {
    const { target: position } = device.motion(servo);
    const others = pose.targets.filter((target) => target.servo !== servo);
    const targets = isIn && position !== null ? [...others, { servo, position }] : others;
    poses.book.edit(
      () => words.poses.steps.servos({ name: pose.name }),
      (book) => setPose(book, pose.id, targets),
    );
  }

  const choice = ({ servo, name }: Pick<RobotServo, 'servo' | 'name'>) => {
    const isIn = included.has(servo);
    const isLast = isIn && included.size === 1;
    return (
      <label key={servo} className={styles.servo}>
        <input
          type="checkbox"
          checked={isIn}
          disabled={isIn ? isLast : !sameUnit || !known.includes(servo)}
          onChange={({ target }) => choose(servo, target.checked)}
        />
        {name}
      </label>
    );
  };

  return (
    <fieldset
      className={styles.drawer}
      aria-label={words.poses.servosOf({ count: included.size, all: servos.length + unknown.length })}
    >
      <p className={styles.hint}>{words.poses.servosHint}</p>
      <div className={styles.limbs}>
        {limbsOf(servos).map(({ group, servos: members }) => (
          <fieldset key={group} className={styles.limb}>
            {group !== '' && <legend className={styles.limbName}>{group}</legend>}
            <div className={styles.servos}>{members.map(choice)}</div>
          </fieldset>
        ))}
        {unknown.map((servo) => choice({ servo, name: words.robots.absent({ servo }) }))}
      </div>
    </fieldset>
  );
}

export const posesParts: PanelParts = {
  title: () => words.poses.title,
  Tools,
  Content,
  className: styles.panel,
};

function Tools() {
  return <UndoTools of={useStores().poses.book} />;
}

function Content() {
  const isEmpty = usePoses(({ present }) => present.poses.length === 0);
  const pose = useSelectedPose();
  const [drawer, setDrawer] = useState<Drawer | null>(null);
  const cards = useRef<HTMLDivElement>(null);
  const name = useNaming(cards);
  return (
    <>
      <div ref={cards} className={styles.cards}>
        {isEmpty ? <EmptyPoses /> : <PoseList />}
      </div>
      <PoseTools drawer={drawer} onDrawer={setDrawer} />
      {pose !== undefined && drawer === 'servos' && <ServoPicker pose={pose} />}
      {pose !== undefined && drawer === 'blend' && <BlendBar key={pose.id} pose={pose} />}
      <PoseVerbs onNew={name} />
    </>
  );
}

/** Export and import of poses. An import adds to the existing poses. */
function PoseFiles() {
  const { poses, notices } = useStores();
  const book = usePoses(({ present }) => present);
  const { name } = useRobot();
  const input = useRef<HTMLInputElement>(null);

  function take(files: FileList | null): void {
    files?.[0]?.text().then(poses.importText, () => notices.show('warning', words.poses.unreadableFile));
  }

  return (
    <>
      <input
        ref={input}
        type="file"
        accept=".json,application/json"
        hidden
        onChange={({ target }) => {
          take(target.files);
          // Allows choosing the same file again.
          target.value = '';
        }}
      />
      <IconButton icon="upload" label={words.poses.import} onPress={() => input.current?.click()} />
      <IconButton
        icon="save"
        label={words.poses.export}
        isDisabled={book.poses.length === 0}
        onPress={() =>
          saveFile({ name: `${words.poses.fileName({ robot: name })}.json`, text: poseBookToText(book) })
        }
      />
    </>
  );
}

interface PoseVerbsProps {
  /** Called for a pose captured by a key, to edit its name; not while keys drive the robot. */
  onNew(captured: Captured): void;
}

export function PoseVerbs({ onNew }: PoseVerbsProps) {
  const { poses } = useStores();
  const poseMs = useView((state) => state.poseMs);
  const restName = usePoses(({ present }) => poseName(present, present.restId ?? 'home'));
  const mayMove = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const hints = { home: words.poses.homeHint, rest: words.poses.restHint({ name: restName }) };
  return (
    <div className={styles.verbs}>
      <Capture onNew={onNew} />
      <PoseFiles />
      <span className={styles.ways}>
        {POSE_VERBS.map((verb) => (
          <Button
            key={verb}
            icon={verb}
            hint={hints[verb]}
            isDisabled={!mayMove}
            onPress={() => poses.apply(verb, poseMs)}
          >
            {words.poses.verbs[verb]}
          </Button>
        ))}
        <PoseTime />
      </span>
    </div>
  );
}

function Capture({ onNew }: PoseVerbsProps) {
  const stores = useStores();
  const capture = (press: MouseEvent): void => {
    stores.poses.capture();
    const { selectedPose } = stores.view.getState();
    const isNamed = isByKey(press) && !stores.pad.store.getState().isDriving;
    if (isNamed && selectedPose !== null) onNew({ pose: selectedPose, from: press.currentTarget });
  };
  return <CaptureButton label={words.poses.capture} hint={words.poses.captureHint} onPress={capture} />;
}

function PoseTime() {
  const { view } = useStores();
  const poseMs = useView((state) => state.poseMs);
  const { min, max } = useDevice((state) => state.family.durationMs);
  return (
    <span className={styles.time}>
      <span aria-hidden="true">{words.poses.timeLabel}</span>
      <CheckedNumber
        label={words.poses.time}
        value={poseMs}
        min={min}
        max={max}
        step={100}
        unit={words.servos.ms}
        onChange={(durationMs) => view.setState({ poseMs: durationMs })}
      />
    </span>
  );
}
