// Every panel in every state, one specimen below the other, fed by plain values. A list on top leads to each; `?state=` in
// the address shows one alone. The panels are the real ones, the session behind them is frozen.

import { useState } from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { insertFrame, setMeta } from '#shared/actions/group/groupEdits.ts';
import { gaugeOf, type Reading } from '#shared/actions/battery/batteryGauge.ts';
import { fedBy } from '#shared/actions/battery/batterySupply.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import { FAMILIES, UNKNOWN_BOARD, type Family } from '#shared/protocol/families.ts';
import { ActionsPanel } from '../actions/ActionsPanel.tsx';
import { BatteryPanel } from '../battery/BatteryPanel.tsx';
import { BoardPanel } from '../board/BoardPanel.tsx';
import { pageClock } from '../connect/page.ts';
import { LogPanel } from '../console/LogPanel.tsx';
import { ThisBoard } from '../identity/ThisBoard.tsx';
import { LivePanel } from '../servos/LivePanel.tsx';
import type { BatteryStore } from '../stores/battery.ts';
import { nameOf } from '../stores/boards.ts';
import type { RobotStore } from '../stores/robots.ts';
import { editServoView, StoresContext, type Stores } from '../stores/stores.ts';
import { useSpokenLocale } from '../ui/useSpokenLocale.ts';
import { TopBar } from '../topBar/TopBar.tsx';
import { ConnectSpecimens } from './ConnectSpecimens.tsx';
import { FileSpecimens } from './FileSpecimens.tsx';
import { LibrarySpecimens } from './LibrarySpecimens.tsx';
import { MessageSpecimens } from './MessageSpecimens.tsx';
import { PeopleSpecimens } from './PeopleSpecimens.tsx';
import { PlaySpecimens } from './PlaySpecimens.tsx';
import { PoseSpecimens } from './PoseSpecimens.tsx';
import { TimelineSpecimens } from './TimelineSpecimens.tsx';
import { RobotSpecimens } from './RobotSpecimens.tsx';
import { PadSpecimens } from './PadSpecimens.tsx';
import { RawSpecimens } from './RawSpecimens.tsx';
import { frozenSession } from './frozen.ts';
import { specimenStores } from './specimenStores.ts';
import { motionsOf, SPECIMENS, type BatteryFeed, type Specimen } from './specimens.ts';
import { SAMPLE_TRAFFIC } from './traffic.ts';
import { words } from '../words/words.ts';
import styles from './Gallery.module.css';

export function Gallery() {
  const wanted = new URLSearchParams(location.search).get('state');
  const locale = useSpokenLocale();
  const [blank] = useState(() => storesOf(BLANK));
  const shown = SPECIMENS.filter((specimen) => wanted === null || specimen.name === wanted);
  return (
    <I18nProvider locale={locale}>
      <main className={styles.gallery}>
        <nav className={styles.index} aria-label="States" lang="en">
          <a href={addressOf(null)}>All</a>
          {SPECIMENS.map(({ name }) => (
            <a key={name} href={addressOf(name)}>
              {name}
            </a>
          ))}
        </nav>
        {wanted === null && (
          <StoresContext value={blank}>
            <ConnectSpecimens />
            <MessageSpecimens />
            <RawSpecimens />
            <PadSpecimens />
            <PoseSpecimens />
            <PlaySpecimens />
            <FileSpecimens newStores={() => storesOf(BLANK)} />
            <LibrarySpecimens />
            <PeopleSpecimens />
            <TimelineSpecimens />
            <RobotSpecimens newStores={() => storesOf(BLANK)} />
          </StoresContext>
        )}
        {shown.map((specimen) => (
          <Shown key={specimen.name} specimen={specimen} />
        ))}
      </main>
    </I18nProvider>
  );
}

/** Of one state, or of all. */
function addressOf(state: string | null): string {
  const wanted = new URLSearchParams(location.search);
  if (state === null) wanted.delete('state');
  else wanted.set('state', state);
  return `?${wanted.toString()}`;
}

function Shown({ specimen }: { readonly specimen: Specimen }) {
  const [stores] = useState(() => storesOf(specimen));
  return (
    <StoresContext value={stores}>
      <article className={styles.specimen} aria-label={specimen.name}>
        <h2 className={styles.name} lang="en">
          {specimen.name}
        </h2>
        <TopBar onMoveHere={() => undefined} />
        <ThisBoard />
        <div className={styles.panels}>
          <LivePanel />
          <div className={styles.column}>
            <ActionsPanel />
            <div className={styles.row}>
              <BoardPanel />
              <BatteryPanel />
            </div>
            <div className={styles.log}>
              <LogPanel />
            </div>
          </div>
        </div>
      </article>
    </StoresContext>
  );
}

/** As before anything is connected. */
const BLANK: Specimen = { name: '', way: null, state: INITIAL_STATE, pose: 'unknown', frames: 0 };

function storesOf(specimen: Specimen): Stores {
  const family = specimen.isUnknown === true ? UNKNOWN_BOARD : FAMILIES[specimen.board ?? 'doc'];
  const stores = specimenStores(family);
  const { device, document, view, boards, lastPoses, robots, battery } = stores;
  if (specimen.robot !== undefined) robots.add(() => words.robots.steps.add, specimen.robot.robot());
  const motions = motionsOf(specimen);
  const { way, lastPositions: positions } = specimen;
  if (way !== null && positions !== undefined && family.id !== 'unknown')
    lastPoses.setState({ [nameOf(way)]: { family: family.id, positions } });
  if (specimen.way !== null) device.attach(frozenSession(family, specimen.state, motions), specimen.way);
  device.refreshTargets();
  if (specimen.feed !== undefined) feed(specimen.feed, robots, battery);
  if (specimen.pose !== 'unknown') for (const entry of SAMPLE_TRAFFIC) device.traffic.add(entry, family.id);
  for (let number = 1; number <= specimen.frames; number++) {
    document.edit(
      () => words.actions.steps.capture,
      (group) => insertFrame(group, group.frames.length, sampleFrame(number, family), family.unit),
    );
  }
  const { groupName: name } = specimen;
  if (name !== undefined)
    document.edit(
      () => words.actions.steps.rename,
      (group) => setMeta(group, { name }),
    );
  view.setState({ selectedFrame: specimen.selectedFrame ?? null, ...specimen.robot?.view });
  editServoView({ view, robots }, (servos) => ({ ...servos, ...specimen.robot?.servos }));
  if (specimen.way !== null && specimen.nickname !== undefined) {
    boards.remember(specimen.way, specimen.board ?? 'doc');
    boards.rename(specimen.way, specimen.nickname);
  }
  return stores;
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
