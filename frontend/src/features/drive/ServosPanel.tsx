// Live control: the picture of the robot and a row per servo, or the servos on the body and a row for the one at hand. Where moving is not possible now it says why, and keeps every
// control in its place.

import { Body } from '../picture/Body.tsx';
import { motionHindrance } from '../../robot/readiness.ts';
import { GENTLE_MOVE_MS } from '../../robot/moveTime.ts';
import { useIsTeaching, useRobot, useSnapshot, useStores, useView } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { laterComponent } from '../../ui/later.tsx';
import { Panel } from '../../ui/Panel.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { useLayout } from '../../ui/useLayout.ts';
import { words } from '../../i18n/words.ts';
import { Legend } from './Legend.tsx';
import { MoveTimeControl } from './MoveTimeControl.tsx';
import { SelectionBar } from './SelectionBar.tsx';
import { ServoAtHand } from './ServoAtHand.tsx';
import { ServoList } from './ServoList.tsx';
import { ServoTalk } from './ServoTalk.tsx';
import { useHand } from './useHand.ts';
import styles from './ServosPanel.module.css';

const BodyMap = laterComponent(async () => (await import('../picture/BodyMap.tsx')).BodyMap, '100%');

export function ServosPanel() {
  const hindrance = useSnapshot(motionHindrance);
  const layout = useView((state) => state.servoLayout);
  const isPhone = useLayout() === 'phone';
  const isTeaching = useIsTeaching();
  const why = hindrance === null ? '' : words.servos.blocked[hindrance];
  return (
    <Panel
      title={words.servos.title}
      note={isPhone ? '' : why}
      className={cx(styles.panel, layout === 'list' && styles.listed)}
      tools={
        <>
          <LayoutChoice />
          <CentreAll />
        </>
      }
    >
      {layout === 'list' ? (
        <Body />
      ) : (
        <div className={styles.map}>
          <BodyMap />
        </div>
      )}
      <Legend />
      <SelectionBar
        hint={isTeaching ? words.teach.on : isPhone && why !== '' ? why : words.servoPanel.selectHint}
      />
      {layout === 'list' ? <ServoList /> : <ServoAtHand />}
      <MoveTimeControl />
      <ServoTalk />
    </Panel>
  );
}

function LayoutChoice() {
  const { view } = useStores();
  const layout = useView((state) => state.servoLayout);
  return (
    <Choice
      label={words.servoPanel.layout}
      value={layout}
      options={[
        { value: 'list', label: words.servoPanel.layouts.list },
        { value: 'body', label: words.servoPanel.layouts.body },
      ]}
      onChange={(servoLayout) => view.setState({ servoLayout })}
    />
  );
}

function CentreAll() {
  const hand = useHand();
  const { servos } = useRobot();
  const isDisabled = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const all = servos.map(({ servo }) => servo);
  return (
    <Button
      icon="centre"
      hint={words.servos.centreHint}
      isDisabled={isDisabled}
      onPress={() => hand.home(all, GENTLE_MOVE_MS)}
    >
      {words.servos.centre}
    </Button>
  );
}
