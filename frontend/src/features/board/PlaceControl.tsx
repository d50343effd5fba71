// Where the group at hand belongs and how often it is run, as it says itself; what is chosen above can be kept in it.

import { setMeta } from '#shared/group/groupEdits.ts';
import { chosenTimes } from './slots/groupPlace.ts';
import { useDocument, useSlot, useStores, useView } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import styles from './BoardPanel.module.css';

export function PlaceControl() {
  const { document, view } = useStores();
  const slot = useDocument(({ present }) => present.slot);
  const times = useDocument(({ present }) => present.times);
  const isEmpty = useDocument(({ present }) => present.frames.length === 0);
  const chosenSlot = useSlot();
  const isKept = useView((state) => chosenTimes(state) === times) && chosenSlot === slot;
  const keep = (): void =>
    document.edit(
      () => words.board.steps.place,
      (group) => setMeta(group, { slot: chosenSlot, times: chosenTimes(view.getState()) }),
    );
  return (
    <div className={styles.place}>
      <p className={styles.hint}>
        {slot === null ? words.board.placeNone({ times }) : words.board.place({ slot, times })}
      </p>
      <Button
        tone="quiet"
        icon="save"
        hint={words.board.keepPlaceHint}
        isDisabled={isKept || isEmpty}
        onPress={keep}
      >
        {words.board.keepPlace}
      </Button>
    </div>
  );
}
