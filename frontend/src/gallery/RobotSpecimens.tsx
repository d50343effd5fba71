// What the dialog about robots shows: the list, the description, and the calibration at each kind of step.

import { useState } from 'react';
import type { Calibration } from '#shared/actions/robot/robotCalibration.ts';
import { FAMILIES } from '#shared/protocol/families.ts';
import { INITIAL_STATE } from '#shared/session/store.ts';
import type { SessionState } from '#shared/session/state.ts';
import { CalibrationWizard } from '../calibration/CalibrationWizard.tsx';
import { RobotEditor } from '../robots/RobotEditor.tsx';
import { RobotList } from '../robots/RobotList.tsx';
import { freshRobot } from '../stores/robots.ts';
import { StoresContext, type Stores } from '../stores/stores.ts';
import { frozenSession } from './frozen.ts';
import { motionsOf } from './specimens.ts';
import { words } from '../words/words.ts';
import styles from './Gallery.module.css';

const BOARD = 'lsc-16';
const FAMILY = FAMILIES[BOARD];
const READY: SessionState = { ...INITIAL_STATE, link: { status: 'ready' } };
const STOPPED: SessionState = { ...READY, latch: { reason: 'pressed', stop: 'sent', unheld: [] } };

interface Case {
  readonly name: string;
  readonly content: 'list' | 'edit' | 'calibrate';
  readonly state?: SessionState;
  readonly isUnknown?: boolean;
  readonly at?: Pick<Calibration, 'servo' | 'step'>;
}

const CASES: readonly Case[] = [
  { name: 'Robots, list', content: 'list' },
  { name: 'Robots, description', content: 'edit' },
  { name: 'Calibration, lowest', content: 'calibrate' },
  { name: 'Calibration, unknown position', content: 'calibrate', isUnknown: true },
  { name: 'Calibration, stopped', content: 'calibrate', state: STOPPED },
  { name: 'Calibration, direction', content: 'calibrate', at: { servo: 3, step: 'direction' } },
  { name: 'Calibration, mirror', content: 'calibrate', at: { servo: 3, step: 'partner' } },
  { name: 'Calibration, trim', content: 'calibrate', at: { servo: 3, step: 'trim' } },
];

const CONTENT = { list: <RobotList />, edit: <RobotEditor />, calibrate: <CalibrationWizard /> } as const;

export interface RobotSpecimensProps {
  /** Stores of a page that has just been opened. */
  newStores(): Stores;
}

export function RobotSpecimens({ newStores }: RobotSpecimensProps) {
  return CASES.map((one) => <RobotSpecimen key={one.name} specimen={one} newStores={newStores} />);
}

function RobotSpecimen({ specimen, newStores }: RobotSpecimensProps & { readonly specimen: Case }) {
  const [stores] = useState(() => prepared(newStores(), specimen));
  return (
    <StoresContext value={stores}>
      <article className={styles.specimen} aria-label={specimen.name}>
        <h2 className={styles.name} lang="en">
          {specimen.name}
        </h2>
        <div className={styles.dialog}>{CONTENT[specimen.content]}</div>
      </article>
    </StoresContext>
  );
}

function prepared(stores: Stores, { state = READY, isUnknown = false, at }: Case): Stores {
  const { robots, device, view } = stores;
  robots.add(() => words.robots.steps.add, freshRobot('humanoid16', BOARD));
  const motions = isUnknown ? {} : motionsOf({ board: BOARD, pose: 'still' });
  const way = { kind: 'simulated', label: 'Simulated board', isSimulated: true } as const;
  device.attach(frozenSession(FAMILY, state, motions), way);
  device.refreshTargets();
  if (at !== undefined)
    view.setState({ calibration: { robotId: robots.current().id, progress: { ...at, done: [] } } });
  return stores;
}
