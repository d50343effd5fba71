// Words about posing the robot by hand.

import { formatNames } from './numbers.ts';

export const teachWords = {
  teach: 'Teach',
  hint: 'Lets go of the servos, so that you pose the robot by hand and capture what is read',
  title: 'Teach by hand?',
  text: 'Every servo lets go and the arm drops: hold it. Then turn it by hand. Its positions are read again and again and drawn; capture frames and poses, or record. At the end the servos hold where they stand, one after another.',
  confirm: 'Release and teach',
  end: 'Hold and end teaching',
  on: 'Teaching: turn the servos by hand, capture, keep holding.',
  status: 'Teaching: keep holding',
  staysReleased: 'Teaching has ended. The servos were not told to hold: keep the arm in your hand.',
  notHeld: (names: readonly string[]): string =>
    `Not held, because it was not read or stands beyond its limits: ${formatNames(names)}. It stays released.`,
};
