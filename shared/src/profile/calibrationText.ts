// How far the calibration of a robot has come, as a text that is kept until it goes on. What is none is not taken.

import * as v from 'valibot';
import { CALIBRATION_STEPS, type Calibration } from './calibration.ts';

/** Of which robot, by its number among those of this browser. */
export interface KeptCalibration {
  readonly robotId: number;
  readonly progress: Calibration;
}

const whole = v.pipe(v.number(), v.safeInteger());
const place = { servo: whole, step: v.picklist(CALIBRATION_STEPS) };

const keptSchema = v.strictObject({
  robotId: whole,
  progress: v.strictObject({
    ...place,
    done: v.array(v.strictObject(place)),
    found: v.optional(
      v.strictObject({ servo: whole, end: v.picklist(['min', 'max']), at: whole, home: whole }),
    ),
  }),
});

export const calibrationToText = (kept: KeptCalibration | null): string => JSON.stringify(kept);

/** null where it tells of none. */
export function calibrationFromText(text: string): KeptCalibration | null {
  try {
    return v.parse(keptSchema, JSON.parse(text));
  } catch {
    return null;
  }
}
