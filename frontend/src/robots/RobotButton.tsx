// The robot at hand by its name, in the bar; opens the list of robots.

import { Button } from 'react-aria-components/Button';
import { useRobot, useStores } from '../stores/stores.ts';
import { Icon } from '../ui/Icon.tsx';
import { words } from '../words/words.ts';
import styles from './RobotButton.module.css';

export function RobotButton() {
  const { view } = useStores();
  const { name } = useRobot();
  return (
    <Button
      className={styles.button ?? ''}
      aria-label={words.robots.button(name)}
      aria-haspopup="dialog"
      onPress={() => view.setState({ robotView: 'list' })}
    >
      <span className={styles.icon}>
        <Icon name="pose" />
      </span>
      <span className={styles.name}>{name}</span>
      <Icon name="down" />
    </Button>
  );
}
