// A dialog in which one robot of the fleet is driven over the broker: its picture, who drives, a slider for each servo, a run of a stored
// group, and STOP always in view. Who closes it gives the lease back.

import { useEffect, useState } from 'react';
import { useStore } from 'zustand';
import type { FleetRobot, FleetTask } from '#shared/client/http.generated.ts';
import { words } from '../i18n/whole.ts';
import { RobotThumb } from '../features/picture/PoseThumb.tsx';
import { servoOf } from '#shared/profile/robot.ts';
import { moveDurationMs } from '../robot/moves.ts';
import { Button } from '../ui/Button.tsx';
import { Chip, Mark } from '../ui/Chip.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { Select } from '../ui/Select.tsx';
import { StopPress } from '../ui/StopKey.tsx';
import { useAsking } from './asking.ts';
import { familyOf, robotOf } from './boards.ts';
import { useFleet, useFleetState } from './context.ts';
import { DriveSlider } from './DriveSlider.tsx';
import type { Driving, DrivingState } from './driving.ts';
import { conditionText, TRUTH } from './FleetCard.tsx';
import { placeOf, poseOf } from './pose.ts';
import { hasMissed, stopText } from './stopText.ts';
import { conditionOf } from './robots.ts';
import styles from './Drive.module.css';

interface DrivePanelProps {
  readonly robot: FleetRobot;
  readonly driving: Driving;
  /** Drives again, after it has ended. */
  onAgain(): void;
  onClose(): void;
}

export function DrivePanel({ robot, driving, onAgain, onClose }: DrivePanelProps) {
  useEffect(() => {
    const follow = (): void => driving.see(document.visibilityState === 'visible');
    follow();
    document.addEventListener('visibilitychange', follow);
    return () => document.removeEventListener('visibilitychange', follow);
  }, [driving]);
  return (
    <Dialog
      title={words.drive.title({ name: robot.name })}
      closeLabel={words.close}
      isOpen
      full
      onClose={onClose}
    >
      <Controls {...{ robot, driving, onAgain }} />
    </Dialog>
  );
}

function Controls({ robot, driving, onAgain }: Omit<DrivePanelProps, 'onClose'>) {
  const fleet = useFleet();
  const stopping = useFleetState((all) => all.stopping);
  const state = useStore(driving.store);
  const family = familyOf(robot.board);
  const profile = robotOf(robot);
  const { motion, own } = state;
  const condition = conditionOf(robot);
  const isStopped = state.latch || condition === 'stopped';
  const { problem, ask } = useAsking();
  const [resumed, setResumed] = useState('');
  const failure = useFleetState(({ tasks }) => failureOf(tasks, resumed));
  const resume = (): void => ask(async () => setResumed((await fleet.api.resume([robot.id])).id));
  const isBlocked = state.lease !== 'driving' || isStopped || state.motion === null || state.isQuiet;
  const pose = poseOf(motion, profile.servos);
  const durationOf = (servo: number, position: number, isLeap: boolean): number =>
    moveDurationMs(isLeap ? 'leap' : 'hand', [{ servo, position }], family, (one) =>
      placeOf(motion, servoOf(profile, one) ?? { servo: one, trim: 0 }),
    );
  return (
    <div className={styles.panel}>
      <div className={styles.side}>
        <div className={styles.picture}>
          <RobotThumb robot={profile} pose={pose} changed={[]} family={family} />
        </div>
        <Chip truth={TRUTH[condition]}>{conditionText(robot, condition)}</Chip>
        <Lease {...{ state, driving, onAgain }} />
        <div className={styles.stop}>
          <StopPress isDisabled={false} onStop={() => void fleet.stop([robot.id])}>
            {words.fleet.stopOne({ name: robot.name })}
          </StopPress>
        </div>
        {isStopped ? (
          <Button wide onPress={resume}>
            {words.stop.resume}
          </Button>
        ) : (
          <RunGroup {...{ robot, driving, isBlocked }} />
        )}
        <div role="alert" className={styles.refusal}>
          {state.refusal !== '' && <p>{state.refusal}</p>}
          {isStopped && (problem !== '' || failure !== '') && <p>{problem || failure}</p>}
          {stopping !== null && hasMissed(stopping) && <p>{stopText(stopping, [robot])}</p>}
        </div>
      </div>
      <ul className={styles.servos} aria-label={words.servos.title}>
        {profile.servos.map((servo) => {
          const { servo: number, trim } = servo;
          const place = placeOf(motion, servo);
          const commanded = own.get(number);
          return (
            <DriveSlider
              key={number}
              {...{ servo, isBlocked, unit: family.unit }}
              place={{ ...place, target: commanded === undefined ? place.target : commanded - trim }}
              onMove={(position, isLeap) =>
                driving.move(number, position + trim, durationOf(number, position, isLeap))
              }
            />
          );
        })}
      </ul>
    </div>
  );
}

/** Why the task failed at its robot; empty where it did not, or has not yet. */
function failureOf(tasks: readonly FleetTask[], id: string): string {
  const task = tasks.find((one) => one.id === id);
  return task?.parts.find(({ status }) => status === 'failed')?.detail ?? '';
}

interface LeaseProps {
  readonly state: DrivingState;
  readonly driving: Driving;
  onAgain(): void;
}

/** Who drives, and how to drive again. */
function Lease({ state: { link, lease, driver, reason, isQuiet }, driving, onAgain }: LeaseProps) {
  if (link === 'ended') {
    return (
      <div className={styles.lease} role="status">
        <span className={styles.who}>
          <Mark truth="unknown" />
          {reason === '' ? words.drive.ended : reason}
        </span>
        <Button wide onPress={onAgain}>
          {words.drive.again}
        </Button>
      </div>
    );
  }
  return (
    <div className={styles.lease} role="status">
      <span className={styles.who}>
        <Mark truth={lease === 'driving' && !isQuiet ? 'confirmed' : 'unknown'} />
        {lease === 'driving' && isQuiet ? words.drive.quiet : leaseText(lease, driver)}
      </span>
      {lease === 'none' && (
        <Button wide onPress={() => driving.request()}>
          {words.lease.request}
        </Button>
      )}
    </div>
  );
}

function leaseText(lease: DrivingState['lease'], driver: string | null): string {
  if (lease === 'driving') return words.lease.drives;
  if (lease === 'requested')
    return driver === null ? words.drive.requesting : words.lease.asked({ name: driver });
  return driver === null ? words.lease.noDriver : words.lease.driver({ name: driver });
}

interface RunGroupProps {
  readonly robot: FleetRobot;
  readonly driving: Driving;
  readonly isBlocked: boolean;
}

function RunGroup({ robot: { slots }, driving, isBlocked }: RunGroupProps) {
  const [wanted, setWanted] = useState<number | null>(null);
  const slot = slots.find((one) => one.slot === wanted) ?? slots[0];
  if (slot === undefined) return null;
  return (
    <div className={styles.run}>
      <Select
        label={words.fleet.groupToRun}
        value={String(slot.slot)}
        options={slots.map((one) => ({
          value: String(one.slot),
          label: one.name === '' ? words.slots.name({ slot: one.slot }) : one.name,
        }))}
        onChange={(value) => setWanted(Number(value))}
      />
      <Button icon="play" isDisabled={isBlocked} onPress={() => driving.run(slot.slot)}>
        {words.fleet.run({ count: 1 })}
      </Button>
    </div>
  );
}
