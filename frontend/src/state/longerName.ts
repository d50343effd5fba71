// A name with something added to it, such as “Wave, other version”: as long as a name may be, and what is added is whole.

import { NAME_LENGTH } from '#shared/profile/robot.ts';

export function longerName(name: string, added: (values: { readonly name: string }) => string): string {
  return added({ name: name.slice(0, NAME_LENGTH - added({ name: '' }).length).trim() });
}
