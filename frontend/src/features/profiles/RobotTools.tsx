// What can be done with the robot at hand.

import { robotToText } from '#shared/profile/robotText.ts';
import type { OwnRobot } from './robots.ts';
import { useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { saveFile } from '../../ui/saveFile.ts';
import { words } from '../../i18n/whole.ts';
import styles from './RobotList.module.css';

export function RobotTools({ id, robot, isLast }: OwnRobot & { readonly isLast: boolean }) {
  const { robots, view } = useStores();
  return (
    <div className={styles.tools}>
      <Button tone="primary" icon="dial" onPress={() => view.setState({ robotView: 'calibrate' })}>
        {words.robots.calibrate}
      </Button>
      <Button icon="edit" onPress={() => view.setState({ robotView: 'edit' })}>
        {words.robots.edit}
      </Button>
      <Button tone="quiet" icon="copy" onPress={robots.duplicate}>
        {words.robots.duplicate}
      </Button>
      <Button
        tone="quiet"
        icon="download"
        onPress={() => saveFile({ name: fileName(robot.name), text: robotToText(robot) })}
      >
        {words.robots.export}
      </Button>
      <Button tone="quiet" icon="trash" isDisabled={isLast} onPress={() => robots.remove(id)}>
        {words.robots.remove}
      </Button>
    </div>
  );
}

/** Whatever file systems do not bear is left out. */
function fileName(robot: string): string {
  const plain = robot.replaceAll(/[^\p{L}\p{N} ._-]/gu, '').trim();
  return `${plain === '' ? 'robot' : plain}.json`;
}
