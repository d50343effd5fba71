// Live control: the picture of the robot and a row per servo, or the servos on the body and a row for the current one. Where moving
// is not possible now the panel says why and keeps every control in its place.

import { useState } from 'react';
import { type BodyKind, servoOf } from '#shared/profile/robot.ts';
import {
  useKnownFamily,
  useStores,
  useRobot,
  useServoView,
  useDevice,
  useView,
  editServoView,
  useIsTeaching,
  useSnapshot,
} from '../stores.ts';
import { LiveText } from '../../ui/LiveText.tsx';
import { words } from '../../i18n/words.ts';
import { SharedSheet } from '../picture/SharedSheet.tsx';
import { ServoRow } from './ServoRow.tsx';
import { motionHindrance, tellsPositions } from '../../robot/readiness.ts';
import { Choice } from '../../ui/Toggle.tsx';
import { select, type ServoView } from '../servoView.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { Body, RobotView } from '../picture/Body.tsx';
import { BodyMap, CameraView, labelOf, Legend, UnitChoice } from './RobotPanel.tsx';
import type { ServoLayout } from '../view.ts';
import { GENTLE_MOVE_MS } from '../../robot/moves.ts';
import { cx } from '../../ui/cx.ts';
import { Panel } from '../../ui/Panel.tsx';
import { useLayout } from '../../ui/useLayout.ts';
import { ServoList } from './ServoList.tsx';
import { useServoMoves } from './useServoMoves.ts';
import selectionBarStyles from './SelectionBar.module.css';
import styles from './ServosPanel.module.css';
import type { TrafficLog } from '../../robot/traffic.ts';

const WINDOW_MS = 1000;

/** Packets sent in the last second, and servos whose newest target is still queued. Hidden from screen readers. */
function SendRate() {
  const { device } = useStores();
  return (
    <LiveText
      isSilent
      text={() =>
        words.servoPanel.sending({
          packetsPerSecond: sentSince(device.traffic, device.clock.now() - WINDOW_MS),
          waiting: device.waiting(),
        })
      }
      eachMs={WINDOW_MS}
      className={styles.rate}
      title={words.servoPanel.sendingHint}
    />
  );
}

const ALONE: readonly number[] = [];

/** Beside the body: the controls of the servo selected last. The other selected servos move with it. */
function CurrentServo() {
  const robot = useRobot();
  const last = useServoView(({ selected }) => selected.at(-1));
  const servo = last === undefined ? undefined : servoOf(robot, last);
  return (
    <div className={styles.place}>
      {servo === undefined ? (
        <p className={styles.hint}>{words.servoPanel.pressHint}</p>
      ) : (
        <SharedSheet>
          <ol>
            <ServoRow key={servo.servo} servo={servo} order={ALONE} />
          </ol>
        </SharedSheet>
      )}
    </div>
  );
}

const Selected = laterComponent(
  async () => (await import('./Selected.tsx')).Selected,
  'calc(var(--control) + 2px)',
);

/** The selected servos, or `hint` while none is selected. The same height in both cases. */
function SelectionBar({ hint }: { readonly hint: string }) {
  const selected = useServoView((view) => view.selected);
  return (
    <div className={selectionBarStyles.bar} role="group" aria-label={words.servoPanel.selection}>
      {selected.length === 0 ? <NothingSelected hint={hint} /> : <Selected selected={selected} />}
    </div>
  );
}

function NothingSelected({ hint }: { readonly hint: string }) {
  const stores = useStores();
  const { servos } = useRobot();
  const hidden = useServoView((view) => view.hidden);
  const isSomeHeld = useServoView(({ locked, solo }) => locked.length + solo.length > 0);
  const edit = (change: Partial<ServoView>): void =>
    editServoView(stores, (view) => ({ ...view, ...change }));
  const shown = servos.map(({ servo }) => servo).filter((servo) => !hidden.includes(servo));
  return (
    <div className={selectionBarStyles.line}>
      <Button tone="quiet" onPress={() => editServoView(stores, (view) => select(view, shown))}>
        {words.servoPanel.selectAll}
      </Button>
      {isSomeHeld && (
        <Button tone="quiet" icon="lock" onPress={() => edit({ locked: [], solo: [] })}>
          {words.servoPanel.unlockAll}
        </Button>
      )}
      {hidden.length > 0 && (
        <Button tone="quiet" onPress={() => edit({ hidden: [] })}>
          {words.servoPanel.showHidden({ count: hidden.length })}
        </Button>
      )}
      {!isSomeHeld && hidden.length === 0 && <span className={selectionBarStyles.hint}>{hint}</span>}
    </div>
  );
}

const USUAL_MS = 1000;

/** The duration of moves by the sliders: following the pointer, or a set time. */
function MoveTimeControl() {
  const { view, notices } = useStores();
  const moveTime = useView((state) => state.moveTime);
  const { min, max } = useDevice((state) => state.family.durationMs);
  const [lastMs, setLastMs] = useState(USUAL_MS);
  const isTimed = moveTime !== 'hand';
  const setMs = (durationMs: number): void => {
    setLastMs(durationMs);
    view.setState({ moveTime: durationMs });
  };
  return (
    <div className={styles.control}>
      <span className={styles.label} aria-hidden="true">
        {words.servos.moveTime}
        <SendRate />
      </span>
      <Choice
        label={words.servos.moveTime}
        value={isTimed ? 'timed' : 'hand'}
        options={(['hand', 'timed'] as const).map((value) => ({
          value,
          label: words.servos.moveTimes[value],
        }))}
        onChange={(choice) => view.setState({ moveTime: choice === 'hand' ? 'hand' : lastMs })}
      />
      <span className={isTimed ? undefined : styles.away}>
        <NumberField
          label={words.servos.moveTimeField}
          value={isTimed ? moveTime : lastMs}
          min={min}
          max={max}
          step={100}
          unit={words.servos.ms}
          onChange={setMs}
          onRefused={(value) =>
            notices.refuse(words.refused({ name: words.servos.moveTime, value, min, max }))
          }
        />
      </span>
      <p className={styles.about}>{words.servos.moveTimeAbout[isTimed ? 'timed' : 'hand']}</p>
    </div>
  );
}

const ServoTalk = laterComponent(async () => (await import('./ServoTalk.tsx')).ServoTalk, '3rem');

interface ServosPanelProps {
  /** The robot stands in a panel of its own beside this one. */
  readonly isBesideRobot?: boolean;
}

export function ServosPanel({ isBesideRobot = false }: ServosPanelProps) {
  const hindrance = useSnapshot(motionHindrance);
  const tells = tellsPositions(useKnownFamily());
  const chosen = useServoLayout();
  const layout = isBesideRobot ? 'list' : chosen;
  const isPhone = useLayout() === 'phone';
  const isTeaching = useIsTeaching();
  const isListed = layout === 'list' || layout === 'camera';
  const Picture = { list: Body, body: BodyMap, model: RobotView, camera: CameraView }[layout];
  const why = hindrance === null ? '' : words.servos.blocked[hindrance];
  return (
    <Panel
      title={words.servos.title}
      className={cx(styles.panel, isListed && !isBesideRobot && styles.listed)}
      tools={
        <>
          {isBesideRobot ? <UnitChoice /> : <LayoutChoice />}
          <CentreAll />
        </>
      }
    >
      {!isBesideRobot && (
        <>
          {layout === 'list' && !isPhone ? (
            <Body />
          ) : (
            <div className={isListed ? styles.picture : styles.map}>
              <Picture />
              {isListed && isPhone && <CameraSwitch />}
            </div>
          )}
          {!isPhone && <LegendLine />}
        </>
      )}
      <SelectionBar hint={isTeaching ? words.teach.on : why !== '' ? why : words.servoPanel.selectHint} />
      {isListed ? <ServoList /> : <CurrentServo />}
      {isPhone && <LegendLine />}
      <MoveTimeControl />
      {tells && <ServoTalk />}
    </Panel>
  );
}

/** On a phone below the sliders, of which one more is in sight then. */
function LegendLine() {
  return (
    <div className={styles.line}>
      <Legend />
      <UnitChoice />
    </div>
  );
}

const LAYOUTS = ['list', 'body', 'model', 'camera'] as const;

/** A body without a description has no model. */
const layoutsOf = (body: BodyKind): readonly ServoLayout[] =>
  LAYOUTS.filter((layout) => layout !== 'model' || body !== 'plain');

export function useServoLayout(): ServoLayout {
  const { body } = useRobot();
  const layout = useView((state) => state.servoLayout);
  return layoutsOf(body).includes(layout) ? layout : 'list';
}

/** On the picture of a phone, which has no room for one more layout. */
export function CameraSwitch() {
  const { view } = useStores();
  const isOn = useServoLayout() === 'camera';
  return (
    <span className={styles.switch}>
      <IconButton
        icon="camera"
        label={words.workspace.camera}
        aria-pressed={isOn}
        onPress={() => view.setState({ servoLayout: isOn ? 'list' : 'camera' })}
      />
    </span>
  );
}

function LayoutChoice() {
  const { view } = useStores();
  const { body } = useRobot();
  const isPhone = useLayout() === 'phone';
  const layout = useServoLayout();
  const options = layoutsOf(body).filter((value) => !isPhone || value !== 'camera');
  return (
    <Choice
      label={words.servoPanel.layout}
      value={isPhone && layout === 'camera' ? 'list' : layout}
      options={options.map((value) => ({ value, label: labelOf(value) }))}
      onChange={(servoLayout) => view.setState({ servoLayout })}
    />
  );
}

function CentreAll() {
  const servoMoves = useServoMoves();
  const { servos } = useRobot();
  const isDisabled = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const all = servos.map(({ servo }) => servo);
  return (
    <Button
      icon="centre"
      hint={words.servos.centreHint}
      isDisabled={isDisabled}
      onPress={() => servoMoves.home(all, GENTLE_MOVE_MS)}
    >
      {words.servos.centre}
    </Button>
  );
}

/** Counts packets sent, newest first, so that the length of the log does not matter. */
export function sentSince({ store, at }: Pick<TrafficLog, 'store' | 'at'>, sinceMs: number): number {
  const { oldestId, nextId } = store.getState();
  let sent = 0;
  for (let id = nextId - 1; id >= oldestId; id -= 1) {
    const { entry } = at(id);
    if (entry.atMs < sinceMs) break;
    if (entry.mark === 'sent') sent += 1;
  }
  return sent;
}
