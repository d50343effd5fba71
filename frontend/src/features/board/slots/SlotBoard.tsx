// The map of the board's slots, and beside it what is in the one that is chosen.

import { useState } from 'react';
import { useDevice } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { SeveralGroups } from './SeveralGroups.tsx';
import { SlotDetails } from './SlotDetails.tsx';
import { SlotMap } from './SlotMap.tsx';
import styles from './Slots.module.css';

export function SlotBoard({ isSeveralFirst = false }: { readonly isSeveralFirst?: boolean }) {
  const [isSeveral, setSeveral] = useState(isSeveralFirst);
  const canDownload = useDevice((state) => state.family.commands.includes('download'));
  return (
    <>
      <p className={styles.intro}>{words.slots.intro}</p>
      <div className={styles.sides}>
        <SlotMap />
        {isSeveral && canDownload ? (
          <SeveralGroups onBack={() => setSeveral(false)} />
        ) : (
          <SlotDetails onSeveral={canDownload ? () => setSeveral(true) : null} />
        )}
      </div>
    </>
  );
}
