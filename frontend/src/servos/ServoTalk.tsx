// Asking servos where they stand, and letting go of them, where the board can: most cannot, and their owners see nothing of it.

import { mayAsk, motionHindrance, tellsPositions } from '../stores/device/readiness.ts';
import { useDevice, useRobot, useSnapshot, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { Confirm } from '../ui/Confirm.tsx';
import { words } from '../words/words.ts';
import styles from './ServoTalk.module.css';

export function ServoTalk() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const isAllowed = useSnapshot((snapshot) => mayAsk(snapshot, family));
  const servos = useRobot().servos.map(({ servo }) => servo);
  if (!tellsPositions(family)) return null;
  return (
    <div className={styles.talk}>
      <Button
        icon="refresh"
        hint={words.servos.readHint}
        isDisabled={!isAllowed}
        onPress={() => device.readPositions(servos)}
      >
        {words.servos.readPositions}
      </Button>
      {family.commands.includes('release') && <Release servos={servos} />}
    </div>
  );
}

function Release({ servos }: { readonly servos: readonly number[] }) {
  const { device } = useStores();
  const isAllowed = useSnapshot(
    (snapshot) => motionHindrance(snapshot) === null && snapshot.activity.kind === 'idle',
  );
  return (
    <Confirm
      isDisabled={!isAllowed}
      label={words.servos.release}
      title={words.servos.releaseTitle}
      text={words.servos.releaseText}
      keepLabel={words.servos.releaseKeep}
      confirmLabel={words.servos.releaseConfirm}
      closeLabel={words.close}
      onConfirm={() => device.release(servos)}
    />
  );
}
