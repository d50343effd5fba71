// What is kept of a calibration: at which servo and step it is, and which are done. Does nothing.

export const CALIBRATION_STEPS = ['min', 'max', 'home', 'direction', 'partner', 'trim'] as const;
export type CalibrationStep = (typeof CALIBRATION_STEPS)[number];

export interface Calibration {
  readonly servo: number;
  readonly step: CalibrationStep;
  readonly done: readonly Done[];
  /** The end that was found last, with home as it was before any was. */
  readonly found?: FoundEnd | undefined;
}

/** One of the two ends of a servo's way. */
export type End = 'min' | 'max';

export interface FoundEnd {
  readonly servo: number;
  readonly end: End;
  readonly at: number;
  readonly home: number;
}

interface Done {
  readonly servo: number;
  readonly step: CalibrationStep;
}
