// The robot's poses: a contact sheet of cards, what can be done with one, and the ways to home, rest and any pose. The robot
// moves only by the buttons that say so.

import { useRef, useState } from 'react';
import { usePoses, useStores } from '../stores.ts';
import type { PanelParts } from '../../ui/Panel.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { words } from '../../i18n/whole.ts';
import { BlendBar } from './BlendBar.tsx';
import { EmptyPoses } from './EmptyPoses.tsx';
import { PoseList } from './PoseList.tsx';
import { PoseTools, type Drawer } from './PoseTools.tsx';
import { PoseVerbs } from './PoseVerbs.tsx';
import { ServoPicker } from './ServoPicker.tsx';
import { useNaming } from './useNaming.ts';
import { useSelectedPose } from './useSelectedPose.ts';
import styles from './PosesPanel.module.css';

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
