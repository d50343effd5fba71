// Runs the chosen slot, and ends the group that runs.

import { runAsChosen } from '../animate/play/goOn.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { useSnapshot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/words.ts';
import { useFates } from './slots/useFates.ts';
import { useRunSettings } from './useRunSettings.ts';

export function RunControl() {
  const { device, view, notices } = useStores();
  const { slot, times } = useRunSettings();
  const isEmpty = useFates()(slot) === 'empty';
  const isPlaying = useSnapshot(({ activity }) => activity.kind === 'playing');
  const isReady = useSnapshot((snapshot) => snapshot.link.status === 'ready');
  const mayRun = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && !snapshot.brokenSlots.includes(slot),
  );
  const run = (): void => {
    runAsChosen({ device, view }, slot, times);
    if (isEmpty) notices.tell('info', words.board.runsNothing({ slot }));
  };
  return (
    <>
      <Button
        icon="play"
        hint={words.board.runHint({ slot, times })}
        isDisabled={!mayRun || isPlaying}
        onPress={run}
      >
        {words.board.run}
      </Button>
      <Button
        icon="end"
        hint={words.board.stopGroupHint}
        isDisabled={!isReady}
        onPress={() => device.stopGroup()}
      >
        {words.board.stopGroup}
      </Button>
    </>
  );
}
