// How far a calibration has come, at which servo and step, and the same as a text that is stored until it continues. Changes no robot.

import * as v from 'valibot';

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

// How far the calibration of a robot has come, as a text that is stored until it continues. What is none is not taken.

/** Of which robot, by its number among those of this browser. */
export interface StoredCalibration {
  readonly robotId: number;
  readonly progress: Calibration;
}

const whole = v.pipe(v.number(), v.safeInteger());
const place = { servo: whole, step: v.picklist(CALIBRATION_STEPS) };

const storedSchema = v.strictObject({
  robotId: whole,
  progress: v.strictObject({
    ...place,
    done: v.array(v.strictObject(place)),
    found: v.optional(
      v.strictObject({ servo: whole, end: v.picklist(['min', 'max']), at: whole, home: whole }),
    ),
  }),
});

export const calibrationToText = (stored: StoredCalibration | null): string => JSON.stringify(stored);

/** null where it contains none. */
export function calibrationFromText(text: string): StoredCalibration | null {
  try {
    return v.parse(storedSchema, JSON.parse(text));
  } catch {
    return null;
  }
}
