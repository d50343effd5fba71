// Robot files come in by choosing or dropping them. One that cannot be read changes nothing and says why.

import { useState } from 'react';
import { robotFromText } from '#shared/profile/robotText.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { useStores } from '../stores.ts';
import { FileButton } from '../../ui/FileButton.tsx';
import { robotFlawText } from '../../i18n/sentences/robotFlaws.ts';
import { boardName } from '../../i18n/sentences/boards.ts';
import { words } from '../../i18n/whole.ts';
import styles from './RobotList.module.css';

export function ImportRobot({ connected }: { readonly connected: FamilyId | null }) {
  const { robots } = useStores();
  const [outcomes, setOutcomes] = useState<readonly string[]>([]);

  async function take(files: readonly File[]): Promise<void> {
    const read = await Promise.all(files.map(async (file) => ({ file: file.name, text: await file.text() })));
    setOutcomes(read.flatMap(({ file, text }) => imported(file, text) ?? []));
  }

  /** null where the store says itself why not. */
  function imported(file: string, text: string): string | null {
    const found = robotFromText(text);
    if ('problem' in found) return words.robots.notImported({ file, flaw: robotFlawText(found.problem) });
    if (!robots.add(() => words.robots.steps.import, found.robot)) return null;
    const { name, board } = robots.current().robot;
    return connected === null || board === connected
      ? words.robots.imported({ name })
      : words.robots.importedElsewhere({ name, board: boardName(FAMILIES[board]) });
  }

  return (
    <div
      className={styles.zone}
      onDragOver={(event) => event.preventDefault()}
      onDrop={(event) => {
        event.preventDefault();
        void take([...event.dataTransfer.files]);
      }}
    >
      <FileButton accept=".json,application/json" multiple onChoose={(files) => void take(files)}>
        {words.robots.import}
      </FileButton>
      <span className={styles.dim}>{words.robots.importHint}</span>
      <ul className={styles.outcomes} aria-live="polite">
        {outcomes.map((outcome) => (
          <li key={outcome}>{outcome}</li>
        ))}
      </ul>
    </div>
  );
}
