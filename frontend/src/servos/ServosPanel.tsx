// Live control: the picture of the robot and a row per servo. Where moving is not possible now it says why, and keeps every
// control in its place.

import { Body } from '../body/Body.tsx';
import { motionHindrance } from '../stores/readiness.ts';
import { GENTLE_MOVE_MS } from '../stores/moveTime.ts';
import { useRobot, useSnapshot } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { Panel } from '../ui/Panel.tsx';
import { words } from '../words/en.ts';
import { Legend } from './Legend.tsx';
import { MoveTimeControl } from './MoveTimeControl.tsx';
import { SelectionBar } from './SelectionBar.tsx';
import { ServoList } from './ServoList.tsx';
import { ServoTalk } from './ServoTalk.tsx';
import { useHand } from './useHand.ts';
import styles from './ServosPanel.module.css';

export function ServosPanel() {
  const hindrance = useSnapshot(motionHindrance);
  return (
    <Panel
      title={words.servos.title}
      note={hindrance === null ? '' : words.servos.blocked[hindrance]}
      className={styles.panel}
      tools={<CentreAll />}
    >
      <Body />
      <Legend />
      <SelectionBar />
      <ServoList />
      <MoveTimeControl />
      <ServoTalk />
    </Panel>
  );
}

function CentreAll() {
  const hand = useHand();
  const { servos } = useRobot();
  const isDisabled = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const all = servos.map(({ servo }) => servo);
  return (
    <Button
      icon="centre"
      hint={words.servos.centreHint}
      isDisabled={isDisabled}
      onPress={() => hand.home(all, GENTLE_MOVE_MS)}
    >
      {words.servos.centre}
    </Button>
  );
}
