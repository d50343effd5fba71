// The tools for the selected pose. Always present, so that nothing moves when a pose is selected.

import { addMacro } from '#shared/profile/macroEdits.ts';
import { type PoseBook, markRest, setPose } from '#shared/profile/pose.ts';
import { flippedTargets, mirroredTargets } from '#shared/profile/poseShapes.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { putFrame } from '../animate/frames/CaptureButton.tsx';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { servoLabel } from '../../i18n/sentences.ts';
import { holdsMotion } from '#shared/group/group.ts';
import { useDevice, useDocument, usePoses, useRobot, useStores } from '../stores.ts';
import { Button, ActionIconButton } from '../../ui/Button.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import { POSE_ACTIONS, poseContextOf, type PoseContext } from './poseActions.ts';
import { useSelectedPose } from './PoseCard.tsx';
import styles from './PosesPanel.module.css';

/** The label of an undo step. */
type PoseLabel = (name: string) => string;

/** The part that is unfolded below the tools. */
export type Drawer = 'servos' | 'blend';

export interface PoseToolsProps {
  readonly drawer: Drawer | null;
  onDrawer(drawer: Drawer | null): void;
}

export function PoseTools({ drawer, onDrawer }: PoseToolsProps) {
  const pose = useSelectedPose();
  const toggle = (which: Drawer) => (isOn: boolean) => onDrawer(isOn ? which : null);
  return (
    <div className={styles.tools} role="group" aria-label={words.poses.tools}>
      <span className={styles.which}>{pose === undefined ? words.poses.select : pose.name}</span>
      <Arrange />
      <div className={styles.shapes}>
        <Shapes />
        <Toggle
          label={words.poses.servos}
          isOn={drawer === 'servos'}
          isDisabled={pose === undefined}
          onChange={toggle('servos')}
        />
        <Toggle
          label={words.poses.blend}
          isOn={drawer === 'blend'}
          isDisabled={pose === undefined}
          onChange={toggle('blend')}
        />
      </div>
    </div>
  );
}

/** Changes the targets: to the current ones, mirrored, flipped. Also sets the rest pose. */
function Shapes() {
  const { device, poses, notices, macros, document, view } = useStores();
  const pose = useSelectedPose();
  const robot = useRobot();
  const knowsPose = useDevice((state) => state.known.length > 0);
  const unit = useDevice((state) => state.family.unit);
  const restId = usePoses(({ present }) => present.restId);
  const isRest = restId !== null && restId === pose?.id;
  const mayShape = pose?.unit === unit;
  const fitsGroup = useDocument(({ present }) => !holdsMotion(present) || present.unit === pose?.unit);
  const hasSides = (pose?.targets ?? []).some(
    ({ servo }) => typeof servoOf(robot, servo)?.mirror === 'number',
  );

  function edit(label: PoseLabel, change: (book: PoseBook, id: number) => PoseBook): void {
    if (pose !== undefined)
      poses.book.edit(
        () => label(pose.name),
        (book) => change(book, pose.id),
      );
  }

  const update = (): void =>
    edit(
      (name) => words.poses.steps.update({ name }),
      (book, id) => setPose(book, id, device.pose(), unit),
    );

  const reshape = (label: PoseLabel, shape: typeof flippedTargets) => (): void => {
    const { targets, held } = shape(robot, pose?.targets ?? []);
    edit(label, (book, id) => setPose(book, id, targets));
    if (held.length > 0)
      notices.show('warning', words.poses.held({ names: words.numbers.formatNames(held.map(servoLabel)) }));
  };

  const addToGroup = (): void => {
    if (pose === undefined) return;
    putFrame({ document, view }, 'after', pose, () => words.poses.steps.addToGroup({ name: pose.name }));
    notices.show('info', words.poses.added({ name: pose.name }), {
      label: words.poses.openGroup,
      act: () => view.setState({ tab: 'actions', authoring: 'group' }),
    });
  };

  const makeButton = (): void => {
    if (pose === undefined) return;
    const { id, name } = pose;
    macros.edit(
      () => words.macros.edits.add({ name }),
      (page) => addMacro(page, name, [{ kind: 'pose', pose: id, durationMs: GENTLE_MOVE_MS }]),
    );
    notices.show('info', words.poses.buttonMade({ name }));
  };

  return (
    <>
      <Button tone="quiet" icon="update" isDisabled={pose === undefined || !knowsPose} onPress={update}>
        {words.poses.update}
      </Button>
      <Button
        tone="quiet"
        icon="mirror"
        hint={words.poses.mirrorHint}
        isDisabled={!mayShape || !hasSides}
        onPress={reshape((name) => words.poses.steps.mirror({ name }), mirroredTargets)}
      >
        {words.poses.mirror}
      </Button>
      <Button
        tone="quiet"
        icon="flip"
        hint={words.poses.flipHint}
        isDisabled={!mayShape}
        onPress={reshape((name) => words.poses.steps.flip({ name }), flippedTargets)}
      >
        {words.poses.flip}
      </Button>
      <Button
        tone="quiet"
        icon="frames"
        hint={words.poses.addHint}
        isDisabled={pose === undefined || !fitsGroup}
        onPress={addToGroup}
      >
        {words.poses.add}
      </Button>
      <Button tone="quiet" icon="buttons" isDisabled={pose === undefined} onPress={makeButton}>
        {words.poses.button}
      </Button>
      <Toggle
        label={words.poses.makeRest}
        isOn={isRest}
        isDisabled={pose === undefined}
        onChange={(isOn) =>
          edit(
            () => words.poses.steps.rest,
            (book, id) => markRest(book, isOn ? id : null),
          )
        }
      />
    </>
  );
}

function Arrange() {
  const stores = useStores();
  const id = useSelectedPose()?.id ?? null;
  usePoses(({ present }) => present.poses);
  const context = (): PoseContext => poseContextOf(stores);
  return (
    <span className={styles.icons}>
      {(['earlier', 'later', 'duplicate', 'remove'] as const).map((name) => (
        <ActionIconButton key={name} action={POSE_ACTIONS[name]} shown={{ stores, id }} context={context} />
      ))}
    </span>
  );
}
