// One robot of the fleet: what it is, what it does, and whether a person is needed. The whole state is a word and a mark; the card's own
// buttons act on this robot alone.

import { memo } from 'react';
import type { FleetRobot } from '#shared/client/http.generated.ts';
import { boardName } from '../i18n/sentences.ts';
import { words } from '../i18n/whole.ts';
import { RobotThumb } from '../features/picture/PoseThumb.tsx';
import { Button } from '../ui/Button.tsx';
import { Chip, type Truth } from '../ui/Chip.tsx';
import { cx } from '../ui/cx.ts';
import { familyOf, isBatteryLow, usualRobotOf } from './boards.ts';
import { conditionOf, takesMotion, type Condition } from './robots.ts';
import styles from './Fleet.module.css';

export const TRUTH: Readonly<Record<Condition, Truth>> = {
  ...{
    cloned: 'danger',
    lost: 'danger',

    silent: 'unknown',
    stopped: 'warning',
    low: 'warning',
  },
  ...{ busy: 'commanded', driven: 'neutral', ready: 'confirmed' },
};

interface FleetCardProps {
  readonly robot: FleetRobot;
  readonly isSelected: boolean;
  onSelect(id: string, isSelected: boolean): void;
  onStop(id: string): void;
  /** Null where this person may not. */
  readonly onDrive: ((id: string) => void) | null;
}

/** Memoised: of a thousand robots some twenty change at a time. */
export const FleetCard = memo(function FleetCard({
  robot,
  isSelected,
  onSelect,
  onStop,
  onDrive,
}: FleetCardProps) {
  const condition = conditionOf(robot);
  const family = familyOf(robot.board);
  return (
    <li className={cx(styles.card, isSelected && styles.selected)} data-condition={condition}>
      <label className={styles.head}>
        <input
          type="checkbox"
          checked={isSelected}
          aria-label={words.fleet.select({ name: robot.name })}
          onChange={({ target }) => onSelect(robot.id, target.checked)}
        />
        <span className={styles.name}>{robot.name}</span>
      </label>
      <div className={styles.body}>
        <div className={styles.picture}>
          <Picture board={robot.board} />
        </div>
        <div className={styles.facts}>
          <Chip truth={TRUTH[condition]}>{conditionText(robot, condition)}</Chip>
          {condition === 'low' && robot.state?.running && <span>{runningText(robot.state.running)}</span>}
          <span>{robot.robot === '' ? boardName(family) : robot.robot}</span>
          {condition === 'silent' ? (
            <span className={styles.dim}>{words.fleet.lastVolts({ volts: voltsOf(robot) })}</span>
          ) : (
            <>
              <span className={styles.dim}>{driverText(robot)}</span>
              <span className={styles.volts} data-low={isBatteryLow(robot)}>
                {voltsOf(robot)}
              </span>
            </>
          )}
        </div>
      </div>
      <footer className={styles.foot}>
        <span className={styles.dim}>{words.fleet.version({ version: robot.version })}</span>
        {robot.page !== '' && (
          <a
            className={styles.open}
            href={robot.page}
            target="_blank"
            rel="noreferrer"
            aria-label={words.fleet.openPage({ name: robot.name })}
          >
            {words.fleet.open}
          </a>
        )}
        {onDrive !== null && takesMotion(robot) && (
          <Button aria-label={words.drive.title({ name: robot.name })} onPress={() => onDrive(robot.id)}>
            {words.drive.open}
          </Button>
        )}
        <Button
          tone="danger"
          onPress={() => onStop(robot.id)}
          aria-label={words.fleet.stopOne({ name: robot.name })}
        >
          {words.stop.button}
        </Button>
      </footer>
    </li>
  );
});

/** The usual robot of such a board, at rest: the fleet hears a state a second, too seldom for a moving picture. */
function Picture({ board }: { readonly board: string }) {
  const robot = usualRobotOf(board);
  const pose = new Map(robot.servos.map(({ servo, home }) => [servo, home]));
  return <RobotThumb robot={robot} pose={pose} changed={[]} family={familyOf(board)} />;
}

/** The gateway says ages in such steps. */
const JUST_NOW_MS = 10_000;

export function conditionText(robot: FleetRobot, condition: Condition): string {
  const { state } = robot;
  switch (condition) {
    case 'busy':
      return state?.running ? runningText(state.running) : words.fleet.conditions.busy;
    case 'stopped':
      return state?.stoppedBy
        ? words.stop.stoppedBy({ name: state.stoppedBy })
        : words.fleet.conditions.stopped;
    case 'silent':
      return (robot.seenMsAgo ?? 0) < JUST_NOW_MS
        ? words.fleet.conditions[condition]
        : words.fleet.lastSeen({ age: words.dates.formatLongAge(robot.seenMsAgo ?? 0) });
    default:
      return words.fleet.conditions[condition];
  }
}

const runningText = ({ name, slot }: NonNullable<NonNullable<FleetRobot['state']>['running']>): string =>
  name === '' ? words.fleet.runningSlot({ slot }) : words.fleet.running({ name });

function driverText({ state }: FleetRobot): string {
  const driver = state?.driver ?? '';
  return driver === '' ? words.fleet.noDriver : words.fleet.drives({ name: driver });
}

function voltsOf({ state }: FleetRobot): string {
  const batteryMv = state?.batteryMv ?? null;
  return batteryMv === null ? words.battery.noVolts : words.numbers.formatVolts(batteryMv);
}
