// The robot at hand by its name, in the bar; opens the list of robots.

import { useRobot, useStores } from '../stores.ts';
import { Icon } from '../../ui/Icon.tsx';
import { pressOnce } from '../../ui/pressOnce.ts';
import { words } from '../../i18n/words.ts';
import styles from './RobotButton.module.css';

export function RobotButton() {
  const { view } = useStores();
  const { name } = useRobot();
  return (
    <button
      type="button"
      className={styles.button}
      aria-label={words.robots.button({ name })}
      aria-haspopup="dialog"
      onClick={() => view.setState({ robotView: 'list' })}
      onKeyDown={pressOnce}
    >
      <span className={styles.icon}>
        <Icon name="pose" />
      </span>
      <span className={styles.name}>{name}</span>
      <Icon name="down" />
    </button>
  );
}
