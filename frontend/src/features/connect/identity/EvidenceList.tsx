// What a board answered when it was asked who it is, a line for each question.

import type { Evidence } from '#shared/robot/identity.ts';
import { Mark, type Truth } from '../../../ui/Chip.tsx';
import { answerText } from './answerText.ts';
import { words } from '../../../i18n/whole.ts';
import styles from './WhichBoard.module.css';

const TRUTH: Readonly<Record<Evidence['kind'], Truth>> = {
  answered: 'confirmed',
  silent: 'unknown',
  echoed: 'danger',
  noise: 'warning',
};

export function EvidenceList({ evidence }: { readonly evidence: readonly Evidence[] }) {
  return (
    <ul className={styles.evidence} aria-label={words.identity.evidence}>
      {evidence.map((one) => (
        <li key={`${one.kind} ${'question' in one ? one.question : ''}`}>
          <Mark truth={TRUTH[one.kind]} />
          {answerText(one)}
        </li>
      ))}
    </ul>
  );
}
