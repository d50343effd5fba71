// The board at hand: the name the person gave it, what it is taken for and why, and the way to say otherwise.

import { useState } from 'react';
import { useStore } from 'zustand';
import type { Evidence } from '#shared/robot/identity.ts';
import { Mark, type Truth } from '../../../ui/Chip.tsx';
import { heardIn } from '../doctor.ts';
import { answerText, offsetsText } from './answerText.ts';
import { words } from '../../../i18n/whole.ts';
import { mayAsk } from '../../../robot/readiness.ts';
import { useDevice, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { nameOf, NICKNAME_LENGTH } from '../../../robot/remembered.ts';
import { boardName } from '../../../i18n/sentences.ts';
import whichBoardStyles from './WhichBoard.module.css';
import field from '../../../ui/Field.module.css';
import styles from './ThisBoard.module.css';

// What a board answered when it was asked who it is, a line for each question.

const TRUTH: Readonly<Record<Evidence['kind'], Truth>> = {
  answered: 'confirmed',
  silent: 'unknown',
  echoed: 'danger',
  noise: 'warning',
};

export function EvidenceList({ evidence }: { readonly evidence: readonly Evidence[] }) {
  return (
    <ul className={whichBoardStyles.evidence} aria-label={words.identity.evidence}>
      {evidence.map((one) => (
        <li key={`${one.kind} ${'question' in one ? one.question : ''}`}>
          <Mark truth={TRUTH[one.kind]} />
          {answerText(one)}
        </li>
      ))}
    </ul>
  );
}

// Firmware and trims of boards that can tell them, once a person has asked.

export function BoardDetails() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const version = useSnapshot((snapshot) => snapshot.version);
  const offsets = useSnapshot((snapshot) => snapshot.offsets);
  const isAllowed = useSnapshot((snapshot) => mayAsk(snapshot, family));
  if (!family.commands.includes('readOffsets')) return null;
  return (
    <>
      {version !== null && <p>{words.identity.version({ version })}</p>}
      {offsets !== null && <p>{offsetsText(offsets)}</p>}
      <Button tone="quiet" isDisabled={!isAllowed} onPress={device.readDetails}>
        {words.identity.askDetails}
      </Button>
    </>
  );
}

export function ThisBoard() {
  const { device, boards } = useStores();
  const way = useDevice((state) => state.way);
  const family = useDevice((state) => state.family);
  const evidence = useSnapshot((snapshot) => snapshot.identity.evidence);
  const [{ answeredMs }] = useState(() => heardIn(device.traffic));
  const known = useStore(boards.store, (all) => (way === null ? undefined : all[nameOf(way)]));
  if (way === null || way.isSimulated || known === undefined) return null;
  return (
    <section className={styles.board} aria-label={words.identity.thisBoard}>
      <label className={styles.field}>
        <span>{words.identity.nickname}</span>
        <input
          key={known.nickname}
          className={field.field}
          defaultValue={known.nickname}
          maxLength={NICKNAME_LENGTH}
          placeholder={words.identity.nicknameHint}
          autoComplete="off"
          spellCheck={false}
          onBlur={(event) => boards.rename(way, event.target.value)}
          onKeyDown={(event) => {
            if (event.key === 'Enter') event.currentTarget.blur();
          }}
        />
      </label>
      <div className={styles.family}>
        <p>{words.identity.takenFor({ name: boardName(family) })}</p>
        <EvidenceList evidence={evidence} />
        {answeredMs !== null && <p>{words.identity.answeredIn({ ms: Math.round(answeredMs) })}</p>}
        <BoardDetails />
        {family.certainAnswers.length === 0 && <p className={styles.dim}>{words.identity.unproven}</p>}
      </div>
      <Button tone="quiet" icon="refresh" onPress={device.identify}>
        {words.identity.notThis}
      </Button>
    </section>
  );
}
