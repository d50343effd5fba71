// The two LeArms as values: with PWM servos and with bus servos (boards.md chapter 4). Knows no behaviour.

export interface LearmTraits {
  /** What it says of its servos when it is asked for its version (boards.md 2.3). */
  readonly servoType: 1 | 2;
  /** Its first line of text (L1). */
  readonly greeting: string;
  readonly range: { readonly min: number; readonly max: number };
  /** Of servo 1, the gripper, which would break itself beyond (boards.md 2.1). */
  readonly gripper: { readonly min: number; readonly max: number };
  /** Where the servos go at power-up and after a reset (L1). */
  readonly resetPose: readonly number[];
  /** PWM servos are asked whether they have arrived; of bus servos it counts the frame's time (L7). */
  readonly endsFrames: 'arrived' | 'counted';
}

export const PWM_LEARM: LearmTraits = {
  servoType: 1,
  greeting: 'pwm servo',
  range: { min: 500, max: 2500 },
  gripper: { min: 500, max: 1500 },
  resetPose: [770, 1500, 644, 511, 1255, 1500],
  endsFrames: 'arrived',
};

export const BUS_LEARM: LearmTraits = {
  servoType: 2,
  greeting: 'serial servo',
  range: { min: 125, max: 875 },
  gripper: { min: 200, max: 700 },
  resetPose: [226, 500, 177, 129, 408, 500],
  endsFrames: 'counted',
};
