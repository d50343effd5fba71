// One pose as a card with its picture, its name and a button to move there: the face selects, the grip drags; and the focus on the name of a
// pose that has just been captured.

import { type Pose, movePose, renamePose, poseOf } from '#shared/profile/pose.ts';
import { unknownServos } from '#shared/profile/poseShapes.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import { motionHindrance } from '../../robot/readiness.ts';
import { useDevice, useRobot, useSnapshot, useStores, useView, usePoses } from '../stores.ts';
import { IconButton } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { Icon } from '../../ui/Icon.tsx';
import { NameField } from '../../ui/NameField.tsx';
import { useDragOrder, type DragOrder } from '../../ui/cards.ts';
import { words } from '../../i18n/whole.ts';
import card from '../../ui/Card.module.css';
import styles from './PoseCard.module.css';
import { useEffect, useState, type RefObject } from 'react';

export interface PoseCardProps {
  readonly pose: Pose;
  /** What the book of poses says about it, in words; may be empty. */
  readonly marks: string;
  readonly isSelected: boolean;
  readonly isTabStop: boolean;
}

export function PoseCard({ pose, marks, isSelected, isTabStop }: PoseCardProps) {
  const { poses, view } = useStores();
  const family = useDevice((state) => state.family);
  const robot = useRobot();
  const { isDragged, startDrag } = usePoseDrag(pose);
  const { id, name, targets } = pose;
  const all = robot.servos.length + unknownServos(robot, targets).length;
  const servoCount = targets.length;
  const about = servoCount === all ? name : words.poses.about({ name, servoCount, all });
  return (
    <li data-pose={id} className={cx(card.card, isSelected && card.selected, isDragged && card.dragged)}>
      <button
        type="button"
        data-card-face=""
        className={card.face}
        aria-label={marks === '' ? about : `${about}${words.comma}${marks}`}
        aria-pressed={isSelected}
        tabIndex={isTabStop ? 0 : -1}
        onClick={() => view.setState({ selectedPose: id })}
      >
        <span className={styles.marks}>{marks}</span>
        <PoseThumb
          pose={new Map(targets.map(({ servo, position }) => [servo, position]))}
          changed={targets.map(({ servo }) => servo)}
          family={family}
        />
      </button>
      <div className={styles.foot}>
        <NameField
          label={words.poses.name({ name })}
          name={name}
          excludeFromTabOrder={!isTabStop}
          onRename={(wanted) =>
            poses.book.edit(
              () => words.poses.steps.rename({ name }),
              (book) => renamePose(book, id, wanted),
            )
          }
        />
        <Go pose={pose} isTabStop={isTabStop} />
        <span className={card.grip} aria-hidden="true" onPointerDown={startDrag}>
          <Icon name="grip" />
        </span>
      </div>
    </li>
  );
}

function Go({ pose, isTabStop }: { readonly pose: Pose; readonly isTabStop: boolean }) {
  const { poses, view } = useStores();
  const sameUnit = useDevice((state) => state.family.unit === pose.unit);
  const poseMs = useView((state) => state.poseMs);
  const mayMove = useSnapshot((snapshot) => motionHindrance(snapshot) === null);
  const go = (): void => {
    view.setState({ selectedPose: pose.id });
    poses.apply(pose.id, poseMs);
  };
  return (
    <IconButton
      icon="play"
      label={words.poses.go({ name: pose.name, durationMs: poseMs })}
      isDisabled={!mayMove || !sameUnit}
      tabIndex={isTabStop ? 0 : -1}
      onPress={go}
    />
  );
}

function usePoseDrag({ id, name }: Pose): DragOrder {
  const { poses, view } = useStores();
  const { book } = poses;
  return useDragOrder({
    attribute: 'data-pose',
    begin() {
      book.begin(() => words.poses.steps.move({ name }));
      view.setState({ selectedPose: id });
    },
    over(other) {
      const to = book.store.getState().present.poses.findIndex((pose) => pose.id === other);
      if (to >= 0) book.preview((before) => movePose(before, id, to));
    },
    commit: () => book.commit(),
    cancel: () => book.cancel(),
  });
}

export function useSelectedPose(): Pose | undefined {
  const id = useView((state) => state.selectedPose);
  return usePoses(({ present }) => poseOf(present, id));
}

export interface Captured {
  readonly pose: number;
  readonly from: Element;
}

/**
 * Returns a function to call with a pose captured by a key: the focus goes to its name in `list`, and Enter leads back to where the pose
 * was captured.
 */
export function useNaming(list: RefObject<HTMLElement | null>): (captured: Captured) => void {
  const [captured, setCaptured] = useState<Captured | null>(null);

  useEffect(() => {
    if (captured === null) return;
    const { pose, from } = captured;
    const name = list.current?.querySelector<HTMLInputElement>(`[data-pose='${pose}'] input`);
    if (!name) return;
    const key = (event: KeyboardEvent): void => {
      if (event.key !== 'Enter' || !(from instanceof HTMLElement)) return;
      // Otherwise the same key would press the element that gets the focus.
      event.preventDefault();
      from.focus();
    };
    const leave = (): void => setCaptured(null);
    name.focus();
    name.select();
    name.addEventListener('keydown', key);
    name.addEventListener('blur', leave);
    return () => {
      name.removeEventListener('keydown', key);
      name.removeEventListener('blur', leave);
    };
  }, [captured, list]);

  return setCaptured;
}
