// The fleet page: STOP of all robots, what needs a person first, and what is asked of the selected ones. Knows no gateway's routes.

import { useCallback, useState } from 'react';
import type { FleetRobot } from '#shared/client/http.generated.ts';
import { words } from '../i18n/whole.ts';
import { useSpokenLocale } from '../i18n/words.ts';
import { Button } from '../ui/Button.tsx';
import { Mark } from '../ui/Chip.tsx';
import { cx } from '../ui/cx.ts';
import { EmptyState } from '../ui/Panel.tsx';
import { Select } from '../ui/Select.tsx';
import { StopKey } from '../ui/StopKey.tsx';
import field from '../ui/Field.module.css';
import { DrivePanel } from './DrivePanel.tsx';
import { FleetCard } from './FleetCard.tsx';
import { FleetActions } from './FleetActions.tsx';
import { Events, Tasks } from './FleetWork.tsx';
import { CueList } from './CueList.tsx';
import { FleetContext, useFleet, useFleetState } from './context.ts';
import type { Driving } from './driving.ts';
import type { Fleet, FleetState } from './fleetStore.ts';
import { stopText } from './stopText.ts';
import { groupShown, groupsIn, inOrder, matches, needsPerson, type Order } from './robots.ts';
import styles from './Fleet.module.css';

interface FleetPageProps {
  readonly fleet: Fleet;
  /** What the person at this page may do. */
  readonly mayDrive: boolean;
  /** The gateway of this page has a robot of its own. */
  readonly hasOwnRobot: boolean;
  /** The robot that is driven at first; null: none. */
  readonly driven?: string | null;
}

export function FleetPage({ fleet, mayDrive, hasOwnRobot, driven = null }: FleetPageProps) {
  useSpokenLocale();
  return (
    <FleetContext value={fleet}>
      <div className={styles.page}>
        <Header hasOwnRobot={hasOwnRobot} />
        <StopKey label={words.fleet.stopAll} isDisabled={false} onStop={() => void fleet.stop(null)} />
        <Problems />
        <main className={styles.main}>
          <Robots mayDrive={mayDrive} first={driven} />
          <CueList mayDrive={mayDrive} />
          <Tasks mayDrive={mayDrive} />
          <Events />
        </main>
      </div>
    </FleetContext>
  );
}

function Header({ hasOwnRobot }: Pick<FleetPageProps, 'hasOwnRobot'>) {
  const site = useFleetState((state) => state.site);
  const robots = useFleetState((state) => state.robots);
  const isCurrent = useFleetState(isHeard);
  const waiting = robots.filter(needsPerson).length;
  return (
    <header className={styles.header}>
      <div>
        <h1>{words.fleet.title}</h1>
        {site !== '' && <p className={styles.dim}>{words.fleet.siteCount({ site, count: robots.length })}</p>}
      </div>
      <p className={styles.summary} role="status">
        {waiting > 0 && (
          <>
            <Mark truth="warning" />
            {words.fleet.needPerson({ count: waiting })}
          </>
        )}
        {waiting === 0 && isCurrent && robots.length > 0 && (
          <>
            <Mark truth="confirmed" />
            {words.fleet.allWell}
          </>
        )}
      </p>
      <a className={styles.open} href="./">
        {hasOwnRobot ? words.fleet.ownRobot : words.fleet.makeGroups}
      </a>
    </header>
  );
}

/** What the page shows is what the robots say now. */
const isHeard = ({ problem, broker }: FleetState): boolean =>
  problem === null && broker?.status === 'connected';

/** What stands between this page and the robots, and what the latest STOP did. */
function Problems() {
  const problem = useFleetState((state) => state.problem);
  const broker = useFleetState((state) => state.broker);
  const stopping = useFleetState((state) => state.stopping);
  const robots = useFleetState((state) => state.robots);
  return (
    <div role="alert" className={styles.problems}>
      {problem !== null && (
        <p>{problem === '' ? words.fleet.noGateway : words.fleet.gatewayRefuses({ detail: problem })}</p>
      )}
      {problem === null && broker !== null && broker.status !== 'connected' && (
        <p>{words.fleet.noBroker({ detail: broker.detail })}</p>
      )}
      {stopping !== null && <p>{stopText(stopping, robots)}</p>}
    </div>
  );
}

interface Driven {
  /** As it was at first: one that leaves the list is still driven. */
  readonly robot: FleetRobot;
  readonly driving: Driving;
}

function driveOf(fleet: Fleet, id: string, known?: FleetRobot): Driven | null {
  const robot = fleet.store.getState().robots.find((one) => one.id === id) ?? known;
  return robot === undefined ? null : { robot, driving: fleet.drive(id) };
}

function Robots({ mayDrive, first }: { readonly mayDrive: boolean; readonly first: string | null }) {
  const fleet = useFleet();
  const robots = useFleetState((state) => state.robots);
  const search = useFleetState((state) => state.search);
  const wanted = useFleetState((state) => state.group);
  const order = useFleetState((state) => state.order);
  const selected = useFleetState((state) => state.selected);
  const [driven, setDriven] = useState<Driven | null>(() => (first === null ? null : driveOf(fleet, first)));
  const drive = useCallback((id: string) => setDriven(driveOf(fleet, id)), [fleet]);
  const stopOne = useCallback((id: string) => void fleet.stop([id]), [fleet]);
  const isCurrent = useFleetState(isHeard);
  const group = groupShown(wanted, robots);
  const shown = inOrder(
    robots.filter((one) => (group === null || one.groups.includes(group)) && matches(one, search)),
    order,
  );
  const panel = driven !== null && (
    <DrivePanel
      robot={robots.find(({ id }) => id === driven.robot.id) ?? driven.robot}
      driving={driven.driving}
      onAgain={() => setDriven(driveOf(fleet, driven.robot.id, driven.robot))}
      onClose={() => {
        driven.driving.end();
        setDriven(null);
      }}
    />
  );
  if (robots.length === 0) {
    return (
      <>
        {panel}
        {isCurrent ? (
          <EmptyState title={words.fleet.none} hint={words.fleet.noneHint} className={styles.empty} />
        ) : (
          <p className={styles.dim}>{words.fleet.notHeard}</p>
        )}
      </>
    );
  }
  const isAll = shown.length > 0 && shown.every(({ id }) => selected.has(id));
  return (
    <section className={styles.robots} aria-label={words.fleet.robots}>
      <div className={styles.tools}>
        <input
          type="search"
          className={cx(field.field, styles.search)}
          aria-label={words.fleet.search}
          placeholder={words.fleet.search}
          value={search}
          onChange={({ target }) => fleet.store.setState({ search: target.value })}
        />
        <GroupSelect robots={robots} group={group} />
        <Select<Order>
          label={words.fleet.order}
          value={order}
          options={(['urgency', 'name', 'battery'] as const).map((value) => ({
            value,
            label: words.fleet.orders[value],
          }))}
          onChange={(value) => fleet.store.setState({ order: value })}
        />
        <Button tone="quiet" onPress={() => fleet.selectOnly(isAll ? [] : shown.map(({ id }) => id))}>
          {isAll ? words.fleet.selectNone : words.fleet.selectAll({ count: shown.length })}
        </Button>
        {selected.size === 0 && <p className={styles.dim}>{words.fleet.selectHint}</p>}
      </div>
      {selected.size > 0 && <FleetActions mayDrive={mayDrive} shown={shown} />}
      {panel}
      {shown.length === 0 ? (
        <EmptyState title={words.fleet.noMatch} hint={words.fleet.noMatchHint} />
      ) : (
        <ul className={styles.cards} aria-label={words.fleet.robots}>
          {shown.map((robot) => (
            <FleetCard
              key={robot.id}
              robot={robot}
              isSelected={selected.has(robot.id)}
              onSelect={fleet.select}
              onStop={stopOne}
              onDrive={mayDrive ? drive : null}
            />
          ))}
        </ul>
      )}
    </section>
  );
}

const ALL = '';

interface GroupSelectProps {
  readonly robots: readonly FleetRobot[];
  readonly group: string | null;
}

function GroupSelect({ robots, group }: GroupSelectProps) {
  const fleet = useFleet();
  const names = groupsIn(robots);
  if (names.length === 0) return null;
  return (
    <Select
      label={words.fleet.group}
      value={group ?? ALL}
      options={[
        { value: ALL, label: words.fleet.everyGroup },
        ...names.map((name) => ({ value: name, label: name })),
      ]}
      onChange={(name) => fleet.store.setState({ group: name === ALL ? null : name })}
    />
  );
}
