// The sender of packets by hand in each of its cases.

import { FAMILIES, type FamilyId } from '#shared/protocol/families.ts';
import { RawForm } from '../console/RawSender.tsx';
import { judgeText } from '../console/judgeText.ts';
import { words } from '../words/words.ts';
import styles from './Gallery.module.css';

const CASES: readonly {
  readonly name: string;
  readonly text: string;
  readonly board?: FamilyId;
  readonly isConsented?: boolean;
  readonly isStopped?: boolean;
}[] = [
  { name: 'By hand, empty', text: '' },
  { name: 'By hand, not whole', text: '55 55 08 03 01' },
  { name: 'By hand, refused', text: '55 55 02 0C', board: 'learm-esp32', isConsented: true },
  { name: 'By hand, not switched on', text: '55 55 02 0F' },
  { name: 'By hand, ready', text: '55 55 02 0F', isConsented: true },
  {
    name: 'By hand, stopped',
    text: '55 55 05 06 08 01 00',
    isConsented: true,
    isStopped: true,
  },
];

export function RawSpecimens() {
  const nothing = (): void => undefined;
  return CASES.map(({ name, text, board = 'doc', isConsented = false, isStopped = false }) => {
    const obstacle = isStopped ? words.raw.waits : null;
    const judged = judgeText(text, FAMILIES[board]);
    return (
      <article key={name} className={styles.specimen} aria-label={name}>
        <h2 className={styles.name} lang="en">
          {name}
        </h2>
        <RawForm
          {...{ text, judged, obstacle, isConsented }}
          maySend={isConsented && judged.packet !== null && obstacle === null}
          onText={nothing}
          onConsent={nothing}
          onSend={nothing}
        />
      </article>
    );
  });
}
