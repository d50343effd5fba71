// Words of the action group being written: its frames, what is done to them, and the steps that come of it.

import { counted, formatWhole } from './numbers.ts';

const theFrames = (numbers: readonly number[]): string =>
  numbers.length === 1 ? `frame ${formatWhole(numbers[0] ?? 0)}` : counted(numbers.length, 'frame');

export const actionWords = {
  defaultName: 'New group',
  capture: 'Capture frame',
  captureHere: 'Capture',
  captureEndHint: 'Adds the commanded or reported pose at the end of the action group',
  captured: (number: number): string => `Frame ${formatWhole(number)} is captured.`,
  nothingKnown: 'Move a servo first.',
  nothingKnownOrRead: 'Move a servo or read positions first.',
  undo: 'Undo',
  redo: 'Redo',
  undoStep: (label: string): string => `Undo: ${label}`,
  redoStep: (label: string): string => `Redo: ${label}`,
  steps: {
    capture: 'capture a frame',
    update: (number: number): string => `update frame ${formatWhole(number)}`,
    duplicate: (numbers: readonly number[]): string => `duplicate ${theFrames(numbers)}`,
    delete: (numbers: readonly number[]): string => `delete ${theFrames(numbers)}`,
    move: (numbers: readonly number[]): string => `move ${theFrames(numbers)}`,
    cut: (numbers: readonly number[]): string => `cut ${theFrames(numbers)}`,
    paste: (count: number): string => `paste ${counted(count, 'frame')}`,
    time: (number: number): string => `time of frame ${formatWhole(number)}`,
    rename: 'rename group',
    convert: 'convert for this board',
  },
  broken: 'The saved group could not be read. It was set aside unharmed, and a new group begun.',
  notSaved: 'The browser does not store the group; it is kept until the page is closed.',
};
