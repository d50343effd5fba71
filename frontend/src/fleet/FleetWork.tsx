// What was asked of several robots, with an outcome for each, and what happened in the fleet.

import type { FleetRobot, FleetTask } from '#shared/client/http.generated.ts';
import { words } from '../i18n/whole.ts';
import { Button } from '../ui/Button.tsx';
import { Mark } from '../ui/Chip.tsx';
import { ProgressBar } from '../ui/ProgressBar.tsx';
import { useAsking } from './asking.ts';
import { useFleet, useFleetState } from './context.ts';
import styles from './Fleet.module.css';

export function Tasks({ mayDrive }: { readonly mayDrive: boolean }) {
  const tasks = useFleetState((state) => state.tasks);
  const robots = useFleetState((state) => state.robots);
  if (tasks.length === 0) return null;
  return (
    <section className={styles.work} aria-label={words.fleet.tasks}>
      <h2>{words.fleet.tasks}</h2>
      <ul className={styles.list}>
        {tasks.toReversed().map((task) => (
          <Task key={task.id} {...{ task, robots, mayDrive }} />
        ))}
      </ul>
    </section>
  );
}

interface TaskProps {
  readonly task: FleetTask;
  readonly robots: readonly FleetRobot[];
  readonly mayDrive: boolean;
}

function Task({ task, robots, mayDrive }: TaskProps) {
  const fleet = useFleet();
  const { problem, ask } = useAsking();
  const { parts, verb } = task;
  const title = words.fleet.taskNames[verb]({ name: groupNames(task.names), by: task.by });
  const total = parts.length;
  const done = parts.filter(({ status }) => status === 'done').length;
  const failed = parts.filter(({ status }) => status === 'failed');
  const isOver = done + failed.length === total;
  const share = parts.reduce((sum, part) => sum + (part.status === 'done' ? 1 : (part.share ?? 0)), 0);
  const text = words.fleet.progress({ done, total, failed: failed.length });
  const nameOf = (id: string): string => robots.find((one) => one.id === id)?.name ?? id;
  return (
    <li className={styles.task}>
      <div className={styles.taskHead}>
        <Mark truth={failed.length > 0 ? 'warning' : isOver ? 'confirmed' : 'commanded'} />
        <span>{title}</span>
        <span className={styles.dim}>{text}</span>
        {task.spreadMs !== null && (
          <span className={styles.dim}>{words.fleet.spread({ ms: Math.round(task.spreadMs) })}</span>
        )}
        {mayDrive && isOver && failed.length > 0 && (
          <Button onPress={() => ask(() => fleet.api.retry(task.id))}>
            {words.fleet.retry({ count: failed.length })}
          </Button>
        )}
      </div>
      <p role="alert" className={styles.warning}>
        {problem}
      </p>
      {!isOver && (
        <>
          <ProgressBar label={title} done={share} total={total} text={text} />
          <Shares parts={parts} nameOf={nameOf} />
        </>
      )}
      {failed.length > 0 && (
        <ul className={styles.reasons}>
          {failed.map(({ robot, detail }) => (
            <li key={robot}>{words.fleet.failed({ name: nameOf(robot), detail: detail ?? '' })}</li>
          ))}
        </ul>
      )}
    </li>
  );
}

const MOST_NAMED = 3;

/** The groups of a task by their names, or their number. */
export const groupNames = (names: readonly string[]): string =>
  names.length > MOST_NAMED
    ? words.fleet.groupCount({ count: names.length })
    : words.numbers.formatNames(names);

interface SharesProps {
  readonly parts: FleetTask['parts'];
  nameOf(id: string): string;
}

/** How far each robot is that is at work. */
function Shares({ parts, nameOf }: SharesProps) {
  const busy = parts.filter(({ status, share }) => status === 'busy' && share !== null);
  if (busy.length === 0) return null;
  return (
    <ul className={styles.shares}>
      {busy.map(({ robot, share }) => (
        <li key={robot}>
          {words.fleet.shareOf({ name: nameOf(robot), percent: words.numbers.formatPercent(share ?? 0) })}
        </li>
      ))}
    </ul>
  );
}

export function Events() {
  const events = useFleetState((state) => state.events);
  if (events.length === 0) return null;
  return (
    <section className={styles.work} aria-label={words.fleet.events}>
      <h2>{words.fleet.events}</h2>
      <ol className={styles.list}>
        {events.toReversed().map(({ atMs, robot, kind, by }, index) => (
          <li key={`${atMs} ${index}`} className={styles.event}>
            <time className={styles.dim}>{words.dates.formatTimeOfDay(atMs)}</time>
            <span>{robot}</span>
            <span>{by === null ? words.fleet.happened[kind] : words.stop.stoppedBy({ name: by })}</span>
          </li>
        ))}
      </ol>
    </section>
  );
}
