// Firmware and trims of boards that can tell them, once a person has asked.

import { mayAsk } from '../../../robot/readiness.ts';
import { useDevice, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { offsetsText } from './answerText.ts';
import { words } from '../../../i18n/whole.ts';

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
