// The dialog of robots: the list, the editor, and the calibration at each kind of step.

import type { DocumentStore } from '#shared/files/documentStore.ts';
import type { Calibration } from '#shared/profile/calibration.ts';
import { changeServo } from '#shared/profile/robotEdits.ts';
import type { Range } from '#shared/codec/families.ts';
import type { SessionState } from '#shared/robot/state.ts';
import { CalibrationWizard } from '../../features/profiles/calibration/CalibrationWizard.tsx';
import { RobotEditor } from '../../features/profiles/RobotEditor.tsx';
import { RobotList } from '../../features/profiles/RobotList.tsx';
import { freshRobot } from '../../features/profiles/robots.ts';
import type { Stores } from '../../features/stores.ts';
import { standing, type Exhibit } from './exhibit.ts';
import { READY, SIMULATED, WATCHED } from './states.ts';
import { words } from '../../i18n/words.ts';

const BOARD = 'lsc-16';
const STOPPED: SessionState = {
  ...READY,
  latch: { reason: 'pressed', by: null, stop: 'sent', unheld: null },
};

interface Case {
  readonly name: string;
  readonly content: 'list' | 'edit' | 'calibrate';
  readonly state?: SessionState;
  readonly isUnknown?: boolean;
  readonly place?: DocumentStore['place'];
  readonly at?: Pick<Calibration, 'servo' | 'step' | 'found'>;
  /** Of the current servo. */
  readonly limits?: Range;
}

const CASES: readonly Case[] = [
  { name: 'Robots, list', content: 'list' },
  {
    ...{ name: 'Robots, list, at a gateway', content: 'list', place: 'gateway' },
    state: { ...READY, robotOnBoard: { document: 'arm' } },
  },
  { name: 'Robots, description', content: 'edit' },
  { name: 'Calibration, lowest', content: 'calibrate' },
  { name: 'Calibration, unknown position', content: 'calibrate', isUnknown: true },
  { name: 'Calibration, stopped', content: 'calibrate', state: STOPPED },
  { name: 'Calibration, another drives', content: 'calibrate', state: { ...READY, lease: WATCHED } },
  {
    ...{ name: 'Calibration, home moved', content: 'calibrate' },
    at: { servo: 3, step: 'max', found: { servo: 3, end: 'min', at: 1500, home: 1400 } },
  },
  { name: 'Calibration, home first', content: 'calibrate', at: { servo: 3, step: 'direction' } },
  { name: 'Calibration, direction', content: 'calibrate', at: { servo: 2, step: 'direction' } },
  {
    ...{ name: 'Calibration, too little room', content: 'calibrate', at: { servo: 3, step: 'direction' } },
    limits: { min: 1490, max: 1510 },
  },
  { name: 'Calibration, mirror', content: 'calibrate', at: { servo: 3, step: 'partner' } },
  { name: 'Calibration, trim', content: 'calibrate', at: { servo: 3, step: 'trim' } },
];

const CONTENT = { list: <RobotList />, edit: <RobotEditor />, calibrate: <CalibrationWizard /> } as const;

export const ROBOTS: readonly Exhibit[] = CASES.map((specimen) => ({
  name: specimen.name,
  isInDialog: true,
  content: CONTENT[specimen.content],
  stores: () => storesOf(specimen),
}));

function storesOf({ state = READY, isUnknown = false, place = 'browser', at, limits }: Case): Stores {
  const pose = isUnknown ? 'unknown' : 'still';
  const stores = standing({ board: BOARD, way: SIMULATED, state, pose, place });
  const { robots, device, view } = stores;
  const robot = freshRobot('humanoid16', BOARD);
  robots.add(
    () => words.robots.steps.add,
    at === undefined || limits === undefined ? robot : changeServo(robot, at.servo, limits),
  );
  device.refresh();
  if (at !== undefined)
    view.setState({ calibration: { robotId: robots.current().id, progress: { ...at, done: [] } } });
  return stores;
}
