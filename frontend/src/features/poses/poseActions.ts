// The actions of the list of poses, by keys on a card and by buttons.

import { duplicatePose, movePose, poseOf, removePose, type Pose } from '#shared/profile/pose.ts';
import { longerName } from '../../i18n/sentences.ts';
import type { Stores } from '../stores.ts';
import type { Action } from '../../ui/action.ts';
import { cardActions, placeAt } from '../../ui/cards.ts';
import { words } from '../../i18n/whole.ts';

export interface PoseContext {
  readonly stores: Pick<Stores, 'poses' | 'view' | 'notices'>;
  readonly id: number | null;
}

/** Of the selected pose. */
export const poseContextOf = (stores: PoseContext['stores']): PoseContext => ({
  ...{ stores, id: stores.view.getState().selectedPose },
});

const posesOf = ({ stores }: PoseContext): readonly Pose[] =>
  stores.poses.book.store.getState().present.poses;
const indexIn = (context: PoseContext): number => posesOf(context).findIndex(({ id }) => id === context.id);

export const POSE_ACTIONS = {
  ...cardActions<PoseContext>({
    label: (name) => words.poses[name === 'remove' ? 'delete' : name],
    select: () => words.poses.select,
    isNone: (context) => indexIn(context) < 0,
    isFirst: (context) => indexIn(context) === 0,
    isLast: (context) => indexIn(context) === posesOf(context).length - 1,
    move(context, place) {
      const { poses, view, notices } = context.stores;
      const index = indexIn(context);
      const pose = posesOf(context)[index];
      if (pose === undefined) return;
      const to = placeAt(place, index, posesOf(context).length);
      poses.book.edit(
        () => words.poses.steps.move({ name: pose.name }),
        (book) => movePose(book, pose.id, to),
      );
      view.setState({ selectedPose: pose.id });
      notices.say(words.poses.moved({ from: index + 1, to: to + 1 }));
    },
    remove(context) {
      const { poses, view } = context.stores;
      const list = posesOf(context);
      const index = indexIn(context);
      const pose = list[index];
      if (pose === undefined) return;
      view.setState({ selectedPose: list[index + 1]?.id ?? list[index - 1]?.id ?? null });
      poses.book.edit(
        () => words.poses.steps.delete({ name: pose.name }),
        (book) => removePose(book, pose.id),
      );
    },
  }),
  duplicate: {
    ...{ id: 'duplicate', icon: 'copy', keys: [] },
    label: () => words.poses.duplicate,
    enabled: (context) => indexIn(context) >= 0 || words.poses.select,
    run({ stores: { poses, view }, id }) {
      const { present } = poses.book.store.getState();
      const pose = poseOf(present, id);
      if (pose === undefined) return;
      view.setState({ selectedPose: present.nextId });
      poses.book.edit(
        () => words.poses.steps.duplicate({ name: pose.name }),
        (book) => duplicatePose(book, pose.id, longerName(pose.name, words.poses.copyOf)),
      );
    },
  },
} as const satisfies Readonly<Record<string, Action<PoseContext>>>;
