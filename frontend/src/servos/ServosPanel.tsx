// Live control: the picture of the robot and a row per servo. Where moving is not possible now it says why, and keeps every
// control in its place.

import { Body } from '../body/Body.tsx';
import { motionHindrance } from '../stores/readiness.ts';
import { GENTLE_MOVE_MS } from '../stores/moveTime.ts';
import type { RobotServo } from '#shared/actions/robot.ts';
import { useRobot, useSnapshot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { cx } from '../ui/cx.ts';
import { Panel } from '../ui/Panel.tsx';
import { words } from '../words/en.ts';
import { Legend } from './Legend.tsx';
import { MoveTimeControl } from './MoveTimeControl.tsx';
import { ServoRow } from './ServoRow.tsx';
import { ServoTalk } from './ServoTalk.tsx';
import styles from './ServosPanel.module.css';

/** Rows that fit below the picture; more of them scroll. */
const FIT = 6;

export function ServosPanel() {
  const { servos } = useRobot();
  const hindrance = useSnapshot(motionHindrance);
  return (
    <Panel
      title={words.servos.title}
      note={hindrance === null ? '' : words.servos.blocked[hindrance]}
      className={styles.panel}
      tools={<CentreAll servos={servos} />}
    >
      <Body />
      <Legend />
      <ol className={cx(styles.rows, servos.length > FIT && styles.scrolling)}>
        {servos.map((servo) => (
          <ServoRow key={servo.servo} servo={servo} />
        ))}
      </ol>
      <MoveTimeControl />
      <ServoTalk />
    </Panel>
  );
}

function CentreAll({ servos }: { readonly servos: readonly RobotServo[] }) {
  const { device } = useStores();
  const isDisabled = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const centre = (): void => {
    const targets = servos.map(({ servo, home }) => ({ servo, position: home }));
    device.move(targets, GENTLE_MOVE_MS);
  };
  return (
    <Button icon="centre" hint={words.servos.centreHint} isDisabled={isDisabled} onPress={centre}>
      {words.servos.centre}
    </Button>
  );
}
