// Driving by keys and pad: the switch, the picture of what is held, how it feels, and which input does what.

import { servoBoundBy } from '#shared/profile/mapping.ts';
import { GENTLE_MOVE_MS } from '../../robot/moveTime.ts';
import { motionHindrance } from '../../robot/readiness.ts';
import { isHeld } from '../drive/servoView.ts';
import { useDevice, useMapping, usePad, useRobot, useServoView, useSnapshot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import type { PanelParts } from '../../ui/Panel.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { servoLabel } from '../../i18n/sentences/servos.ts';
import { words } from '../../i18n/whole.ts';
import { Bindings } from './Bindings.tsx';
import { Conflicts } from './Conflicts.tsx';
import { FeelControls } from './FeelControls.tsx';
import { PadPicture } from './PadPicture.tsx';
import styles from './PadPanel.module.css';

export const padParts: PanelParts = {
  title: () => words.pad.title,
  Tools,
  Content,
  className: styles.panel,
};

function Content() {
  return (
    <>
      <p className={styles.hint}>
        <Hint />
      </p>
      <FirstMoves />
      <div className={styles.top}>
        <PadPicture />
        <FeelControls />
      </div>
      <Conflicts />
      <Bindings />
    </>
  );
}

function Hint() {
  const isDriving = usePad((state) => state.isDriving);
  const hindrance = useSnapshot(motionHindrance);
  if (hindrance !== null) return words.servos.blocked[hindrance];
  return isDriving ? words.pad.drivingHint : words.pad.driveHint;
}

function Tools() {
  const { pad, mappings } = useStores();
  const isDriving = usePad((state) => state.isDriving);
  const isBlocked = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  return (
    <>
      <UndoTools of={mappings} />
      <span className={styles.drive}>
        <Toggle
          label={words.pad.drive}
          isOn={isDriving}
          isDisabled={isBlocked && !isDriving}
          onChange={pad.drive}
        />
      </span>
    </>
  );
}

/** Speeds begin at a known place: whoever has none is asked for a slow move, never guessed. */
function FirstMoves() {
  const { device } = useStores();
  const { servos } = useRobot();
  const { bindings } = useMapping();
  const known = useDevice((state) => state.known);
  const isDriving = usePad((state) => state.isDriving);
  const view = useServoView((one) => one);
  const bound = new Set(bindings.map(servoBoundBy));
  const unknown = servos.filter(
    ({ servo }) => bound.has(servo) && !known.includes(servo) && !isHeld(view, servo),
  );
  if (!isDriving || unknown.length === 0) return null;
  const goHome = (): void => {
    const homes = unknown.map(({ servo, home }) => ({ servo, position: home }));
    device.move(homes, GENTLE_MOVE_MS);
  };
  return (
    <div className={styles.unknown}>
      <p>{words.pad.allUnknown({ names: words.numbers.formatNames(unknown.map(servoLabel)) })}</p>
      <Button icon="centre" hint={words.pad.firstMoveHint} onPress={goHome}>
        {words.pad.firstMove}
      </Button>
    </div>
  );
}
