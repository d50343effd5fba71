// The robot's poses: a contact sheet of cards, what can be done with one, and the ways to home, rest and any pose. The robot
// moves only by the buttons that say so.

import { useState } from 'react';
import { AuthoringTabs } from '../authoring/AuthoringTabs.tsx';
import { usePoses, useStores } from '../stores/stores.ts';
import { EmptyState } from '../ui/EmptyState.tsx';
import { Panel } from '../ui/Panel.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { words } from '../words/words.ts';
import { BlendBar } from './BlendBar.tsx';
import { PoseList } from './PoseList.tsx';
import { PoseTools, type Drawer } from './PoseTools.tsx';
import { PoseVerbs } from './PoseVerbs.tsx';
import { ServoPicker } from './ServoPicker.tsx';
import { useSelectedPose } from './useSelectedPose.ts';
import styles from './PosesPanel.module.css';

export function PosesPanel() {
  const { poses } = useStores();
  const isEmpty = usePoses(({ present }) => present.poses.length === 0);
  const pose = useSelectedPose();
  const [drawer, setDrawer] = useState<Drawer | null>(null);
  return (
    <Panel
      title={words.poses.title}
      tabs={<AuthoringTabs />}
      tools={<UndoTools of={poses.book} />}
      className={styles.panel}
    >
      {isEmpty ? <EmptyState title={words.poses.empty} hint={words.poses.emptyHint} /> : <PoseList />}
      <PoseTools drawer={drawer} onDrawer={setDrawer} />
      {pose !== undefined && drawer === 'servos' && <ServoPicker pose={pose} />}
      {pose !== undefined && drawer === 'blend' && <BlendBar key={pose.id} pose={pose} />}
      <PoseVerbs />
    </Panel>
  );
}
