// Says which servos nobody knows the position of, before their first move is made. Keeps its line when all are known.

import { useDevice, useRobot, useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import styles from './UnknownNote.module.css';

export function UnknownNote() {
  const { device } = useStores();
  const { servos } = useRobot();
  // Moved by nobody, and nothing told by the board: the motion changes with the store.
  const text = useDevice(({ targets }) => {
    const unknown = servos.filter(
      ({ servo }) => targets[servo] === undefined && device.motion(servo).estimated === null,
    );
    return textOf(
      unknown.map(({ servo }) => servo),
      servos.length,
    );
  });
  return <p className={styles.note}>{text}</p>;
}

function textOf(unknown: readonly number[], count: number): string {
  if (unknown.length === 0) return '';
  return unknown.length === count ? words.body.allUnknown : words.servoPanel.someUnknown(unknown);
}
