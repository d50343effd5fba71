// Words of the servo panel: units, selecting, moving together, locking and hiding, the picture.

import { counted, formatCount, formatList, formatNames, formatWhole } from './numbers.ts';
import { MOST_NAMED } from '../numbers.ts';

/** Named while they fit into a line. */
const servosText = (servos: readonly number[]): string =>
  servos.length > MOST_NAMED
    ? counted(servos.length, 'servo')
    : `${servos.length === 1 ? 'Servo' : 'Servos'} ${formatList(servos)}`;

export const servoPanelWords = {
  figure: (robot: string): string =>
    `${robot}; solid is estimated, outline is commanded, dashed is unknown, dotted is a preview`,
  someUnknown: (servos: readonly number[]): string =>
    `${servosText(servos)}: position unknown, the first move may be slow.`,
  estimated: (position: string): string => `≈ ${position}`,
  /** For ears: `1500 µs, commanded`. */
  commanded: (position: string): string => `${position}, commanded`,
  reported: (position: string): string => `${position}, reported`,
  positionsIn: 'Positions in',
  degrees: '°',
  /** For ears: everything that the row shows beside its figures. */
  about: (name: string, joint: string, marks: readonly string[]): string =>
    [name, ...(joint === name ? [] : [joint]), ...marks].join(', '),
  marks: { locked: 'locked', reversed: 'turns the other way' },
  layout: 'Show servos as',
  layouts: { list: 'List', body: 'Body' },
  places: 'Servos on the body',
  arrange: 'Arrange',
  placeOf: (name: string, joint: string, x: number, y: number): string =>
    `${name}${joint === name ? '' : `, ${joint}`}, at ${formatWhole(x)} % across, ${formatWhole(y)} % down`,
  placeStep: (servo: number): string => `place of servo ${formatWhole(servo)}`,
  atHandHint: 'Press a servo on the body to move it.',
  selection: 'Selected servos',
  selectAll: 'Select all',
  selectGroup: (group: string): string => `Select ${group}`,
  selectShort: 'Select',
  selectHint: 'Press names to move servos together.',
  clear: 'Unselect',
  unbind: 'Unbind all',
  selected: servosText,
  together: 'How they move together',
  ways: { straight: 'Straight', mirrored: 'Mirrored', weighted: 'Weighted' },
  weight: (servo: number): string => `Share of servo ${formatWhole(servo)} in percent`,
  percent: '%',
  home: 'Send home',
  lock: 'Lock',
  unlock: 'Unlock',
  unlockAll: 'Unlock all',
  solo: 'Lock all others',
  /** Of everything that is driven by hand from this screen. */
  staying: (names: readonly string[]): string => {
    if (names.length === 1) return `${formatNames(names)} is locked and stays.`;
    const who = names.length > MOST_NAMED ? counted(names.length, 'servo') : formatNames(names);
    return `${who} are locked and stay.`;
  },
  hide: 'Hide',
  showHidden: (count: number): string => `Show ${formatCount(count)} hidden`,
  fold: (group: string, count: number): string => `${group}, ${counted(count, 'servo')}`,
  noGroup: 'Others',
  refused: (name: string, value: string, min: string, max: string): string =>
    `${name}: ${value} is out of range; it takes ${min} to ${max}.`,
  stoppedBy: (name: string, min: string, max: string): string =>
    `All stopped where ${name} met its limit: it takes ${min} to ${max}.`,
  sending: (packetsPerSecond: number, waiting: number): string =>
    `${counted(packetsPerSecond, 'packet')}/s, ${formatWhole(waiting)} waiting`,
  sendingHint: 'Packets sent in the last second; servos whose newest target has not left yet',
};
