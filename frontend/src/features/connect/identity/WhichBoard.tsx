// Which board is this? What it answered, which boards answer like that, and the person's choice among them. Stands where the
// servos will be until a person has confirmed it.

import { FAMILIES, type Family } from '#shared/codec/families.ts';
import { fitOf, type Fit } from '#shared/robot/identity.ts';
import { useDevice, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Panel } from '../../../ui/Panel.tsx';
import { summaryText, familyText, EvidenceList } from './ThisBoard.tsx';
import { isBoardsOwnCable } from '../../../robot/readiness.ts';
import { boardName } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import styles from './WhichBoard.module.css';

export function WhichBoard() {
  const link = useSnapshot((snapshot) => snapshot.link);
  const isAsking = link.status === 'identifying';
  const isUnsolicited = useSnapshot(({ identity }) => identity.evidence.length === 0);
  const isChanged = link.status === 'refused' && link.error.code === 'wrongBoard';
  const title = isChanged ? 'changed' : isAsking || !isUnsolicited ? 'which' : 'none';
  return (
    <Panel title={words.identity.title[title]}>
      <div className={styles.work}>
        {isAsking ? (
          <p className={styles.lead}>{words.identity.asking}</p>
        ) : isUnsolicited ? (
          <NotConnected />
        ) : (
          <Answered />
        )}
      </div>
    </Panel>
  );
}

/** No board can be queried before a port is open. */
function NotConnected() {
  const { view } = useStores();
  return (
    <>
      <p className={styles.lead}>{words.identity.notConnected}</p>
      <div>
        <Button tone="primary" icon="plug" onPress={() => view.setState({ connectOpen: true })}>
          {words.identity.choosePort}
        </Button>
      </div>
      <details className={styles.others}>
        <summary>{words.identity.beforehand}</summary>
        <Boards families={Object.values(FAMILIES)} />
      </details>
    </>
  );
}

function Answered() {
  const { device } = useStores();
  const { evidence } = useSnapshot((snapshot) => snapshot.identity);
  const isOwnCable = useSnapshot(({ withheld }) => isBoardsOwnCable(withheld));
  const families = Object.values(FAMILIES);
  const fitting = (fit: Fit): readonly Family[] =>
    families.filter((family) => fitOf(family, evidence) === fit);
  const likely = fitting('fits');
  const ruledOut = fitting('contradicts');
  return (
    <>
      <p className={styles.lead}>{summaryText(evidence, isOwnCable)}</p>
      <EvidenceList evidence={evidence} />
      {likely.length > 0 && (
        <section className={styles.choice} aria-label={words.identity.likely}>
          <h3>{words.identity.likely}</h3>
          <Boards families={likely} />
        </section>
      )}
      <div className={styles.again}>
        <Button icon="refresh" onPress={device.identify}>
          {words.identity.again}
        </Button>
        <p className={styles.dim}>{words.identity.againHint}</p>
      </div>
      {likely.length < families.length && (
        <details className={styles.others}>
          <summary>{words.identity.others}</summary>
          <p className={styles.dim}>{words.identity.silentHint}</p>
          <Boards families={fitting('silent')} />
          {ruledOut.length > 0 && (
            <p className={styles.dim}>
              {words.identity.ruledOut({ names: words.numbers.formatNames(ruledOut.map(boardName)) })}
            </p>
          )}
        </details>
      )}
    </>
  );
}

function Boards({ families }: { readonly families: readonly Family[] }) {
  const { device, boards } = useStores();
  const way = useDevice((state) => state.way);
  const choose = (family: Family): void => {
    if (way !== null && family.id !== 'unknown') boards.remember(way, family.id);
    device.choose(family);
  };
  return (
    <ul className={styles.boards}>
      {families.map((family) => (
        <li key={family.id}>
          <Button wide onPress={() => choose(family)}>
            <span className={styles.name}>{boardName(family)}</span>
            <span className={styles.about}>{familyText(family)}</span>
          </Button>
        </li>
      ))}
    </ul>
  );
}
