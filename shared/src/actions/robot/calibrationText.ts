// How far the calibration of a robot has come, as a text that is kept until it goes on. What is none is not taken.

import * as z from 'zod/mini';
import { CALIBRATION_STEPS, type Calibration } from './robotCalibration.ts';

/** Of which robot, by its number among those of this browser. */
export interface KeptCalibration {
  readonly robotId: number;
  readonly progress: Calibration;
}

const whole = z.number().check(z.int());
const place = { servo: whole, step: z.enum(CALIBRATION_STEPS) };

const keptSchema = z.strictObject({
  robotId: whole,
  progress: z.strictObject({
    ...place,
    done: z.array(z.strictObject(place)),
    found: z.optional(z.strictObject({ servo: whole, end: z.enum(['min', 'max']), at: whole, home: whole })),
  }),
});

export const calibrationToText = (kept: KeptCalibration | null): string => JSON.stringify(kept);

/** null where it tells of none. */
export function calibrationFromText(text: string): KeptCalibration | null {
  try {
    return keptSchema.parse(JSON.parse(text));
  } catch {
    return null;
  }
}
