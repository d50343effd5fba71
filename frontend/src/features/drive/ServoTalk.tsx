// Reading positions, releasing servos and posing them by hand, on boards that tell positions; most do not.

import { mayAsk, startHindrance } from '../../robot/readiness.ts';
import { canTeach } from './teaching.ts';
import { useIsTeaching, useKnownFamily, useRobot, useSnapshot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { Confirm } from '../../ui/Confirm.tsx';
import { words } from '../../i18n/whole.ts';
import styles from './ServoTalk.module.css';

export function ServoTalk() {
  const { device } = useStores();
  const family = useKnownFamily();
  const isTeaching = useIsTeaching();
  const isAllowed = useSnapshot((snapshot) => mayAsk(snapshot, family)) && !isTeaching;
  const servos = useRobot().servos.map(({ servo }) => servo);
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
      {canTeach(family) && <Teach />}
    </div>
  );
}

/** Start and end of posing are the same button. */
function Teach() {
  const { teaching } = useStores();
  const isOn = useIsTeaching();
  const isAllowed = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  if (isOn)
    return (
      <Button autoFocus tone="primary" icon="end" onPress={() => teaching.end()}>
        {words.teach.end}
      </Button>
    );
  return (
    <Confirm
      icon="record"
      isDisabled={!isAllowed}
      hint={words.teach.hint}
      label={words.teach.teach}
      title={words.teach.title}
      text={words.teach.text}
      keepLabel={words.servos.releaseKeep}
      confirmLabel={words.teach.confirm}
      closeLabel={words.close}
      onConfirm={() => teaching.begin()}
    />
  );
}

function Release({ servos }: { readonly servos: readonly number[] }) {
  const { device } = useStores();
  const isTeaching = useIsTeaching();
  const isAllowed = useSnapshot((snapshot) => startHindrance(snapshot) === null) && !isTeaching;
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
