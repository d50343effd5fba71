// The board at hand: the name the person gave it, what it is taken for and why, and the way to say otherwise.

import { useStore } from 'zustand';
import { nameOf, NICKNAME_LENGTH } from '../../../robot/boards.ts';
import { useDevice, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { boardName } from '../../../i18n/sentences/boards.ts';
import { words } from '../../../i18n/whole.ts';
import { BoardDetails } from './BoardDetails.tsx';
import { EvidenceList } from './EvidenceList.tsx';
import field from '../../../ui/Field.module.css';
import styles from './ThisBoard.module.css';

export function ThisBoard() {
  const { device, boards } = useStores();
  const way = useDevice((state) => state.way);
  const family = useDevice((state) => state.family);
  const evidence = useSnapshot((snapshot) => snapshot.identity.evidence);
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
        <BoardDetails />
        {family.certainAnswers.length === 0 && <p className={styles.dim}>{words.identity.unproven}</p>}
      </div>
      <Button tone="quiet" icon="refresh" onPress={device.identify}>
        {words.identity.notThis}
      </Button>
    </section>
  );
}
