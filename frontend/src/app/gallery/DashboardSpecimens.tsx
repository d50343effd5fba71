// The whole dashboard, or the parts that a state concerns, with a frozen robot behind it.

import { gaugeOf, type Reading, fedBy } from '#shared/profile/battery.ts';
import { totalDurationMs } from '#shared/group/group.ts';
import { insertFrame, setMeta } from '#shared/group/groupEdits.ts';
import { FAMILIES, UNKNOWN_BOARD, type Family } from '#shared/codec/families.ts';
import { actionsParts } from '../../features/animate/frames/ActionsPanel.tsx';
import { AuthoringPanel } from '../Authoring.tsx';
import { BatteryPanel } from '../../features/battery/BatteryPanel.tsx';
import { CompileRow } from '../../features/animate/group/CompileRow.tsx';
import { BoardPanel } from '../../features/board/BoardPanel.tsx';
import { pageClock } from '../page.ts';
import { LogPanel } from '../../features/log/LogPanel.tsx';
import { ThisBoard } from '../../features/connect/identity/ThisBoard.tsx';
import { LivePanel } from '../workspaces/parts.tsx';
import type { BatteryStore } from '../../features/battery/battery.ts';
import { nameOf } from '../../robot/device.ts';
import type { RobotStore } from '../../features/profiles/robots.ts';
import { editServoView, type Stores } from '../../features/stores.ts';
import { TopBar } from '../TopBar.tsx';
import { words } from '../../i18n/whole.ts';
import { type Exhibit, frozenSession, specimenStores } from './exhibit.ts';
import styles from './Gallery.module.css';
import { SPECIMENS, type Part, type Specimen } from './specimens.ts';
import { motionsOf, READY, USB, type BatteryFeed, SAMPLE_TRAFFIC } from './states.ts';

const EVERYTHING: readonly Part[] = ['bar', 'live', 'group', 'board', 'log'];

export const DASHBOARDS: readonly Exhibit[] = SPECIMENS.map((specimen) => ({
  name: specimen.name,
  content: <Dashboard shows={specimen.shows ?? EVERYTHING} />,
  stores: () => storesOf(specimen),
}));

function Dashboard({ shows }: { readonly shows: readonly Part[] }) {
  const has = (part: Part): boolean => shows.includes(part);
  return (
    <>
      {has('bar') && <TopBar onMoveHere={() => undefined} />}
      {has('bar') && <ThisBoard />}
      <div className={styles.panels}>
        {has('live') && <LivePanel />}
        <div className={styles.column}>
          {has('group') && <AuthoringPanel {...actionsParts} />}
          {has('board') && <BoardRow />}
          {has('log') && <Log />}
        </div>
      </div>
    </>
  );
}

function BoardRow() {
  return (
    <div className={styles.row}>
      <BoardPanel fit={<CompileRow />} />
      <BatteryPanel />
    </div>
  );
}

function Log() {
  return (
    <div className={styles.log}>
      <LogPanel />
    </div>
  );
}

function storesOf(specimen: Specimen): Stores {
  const { board = 'doc', robot, feed: fed, frames = 0, groupName: name, selectedFrame = null } = specimen;
  const family = specimen.isUnknown === true ? UNKNOWN_BOARD : FAMILIES[board];
  const stores = specimenStores(family);
  const { document, view, robots, battery } = stores;
  if (robot !== undefined) robots.add(() => words.robots.steps.add, robot.robot());
  connect(stores, specimen, family);
  if (fed !== undefined) feed(fed, robots, battery);
  const numbers = Array.from({ length: frames }, (_, index) => index + 1);
  document.edit(
    () => words.actions.steps.capture,
    (empty) =>
      numbers.reduce(
        (group, number) => insertFrame(group, group.frames.length, sampleFrame(number, family), family.unit),
        name === undefined ? empty : setMeta(empty, { name }),
      ),
  );
  view.setState({ selectedFrame, ...robot?.view });
  editServoView({ view, robots }, (servos) => ({ ...servos, ...robot?.servos }));
  if (specimen.state?.activity.kind === 'playing') play(stores, specimen.state.activity.frameIndex);
  return stores;
}

function connect(
  { device, boards, lastPoses }: Stores,
  { way = USB, board = 'doc', state = READY, pose = 'still', nickname, lastPositions: positions }: Specimen,
  family: Family,
): void {
  if (way !== null && positions !== undefined)
    lastPoses.setState({ [nameOf(way)]: { family: board, positions } });
  if (way !== null) device.attach(frozenSession(family, state, motionsOf(board, pose)), way);
  device.refresh();
  if (pose !== 'unknown') for (const entry of SAMPLE_TRAFFIC) device.traffic.add(entry, family.id);
  if (way === null || nickname === undefined) return;
  boards.remember(way, board);
  boards.rename(way, nickname);
}

/** On the way to that frame of the group. */
function play({ playback, playhead, document }: Stores, frame: number): void {
  const frames = document.store.getState().present.frames.slice(0, frame + 1);
  playback.store.setState({ phase: 'playing' });
  playhead.go(totalDurationMs(frames) - 50);
}

const READ_EVERY_MS = 5000;

function feed({ kind, volts }: BatteryFeed, robots: RobotStore, battery: BatteryStore): void {
  robots.edit(
    () => words.battery.steps.kind,
    (robot) => fedBy(robot, kind),
  );
  const sinceMs = pageClock.now() - volts.length * READ_EVERY_MS;
  const readings = volts.map((batteryMv, index) => ({
    ...{ atMs: sinceMs + index * READ_EVERY_MS, batteryMv, isAtRest: true },
  }));
  const runs = [
    { fromMs: sinceMs + 300_000, toMs: sinceMs + 420_000 },
    { fromMs: sinceMs + 900_000, toMs: sinceMs + 1_200_000 },
  ];
  const isRunning = ({ atMs }: Reading): boolean =>
    runs.some(({ fromMs, toMs }) => atMs > fromMs && atMs < toMs);
  const read = readings.filter((reading) => !isRunning(reading));
  battery.setState(({ supply }) => ({ readings: read, runs, gauge: gaugeOf(read, supply) }));
}

function sampleFrame(number: number, { position, usualServoCount }: Family) {
  const targets = Array.from({ length: usualServoCount }, (_, index) => {
    const share = 0.5 + 0.35 * Math.sin(number * 0.9 + (index === 1 ? 0 : index) * 1.3);
    return { servo: index + 1, position: Math.round(position.min + share * (position.max - position.min)) };
  });
  return { durationMs: 300 + 100 * (number % 5), targets };
}
