// Tells from whom the robot was handed to this page: whoever has not asked for it may be looking elsewhere.

import { personName } from '../../i18n/sentences/people.ts';
import { words } from '../../i18n/words.ts';
import type { Device } from '../../robot/device.ts';
import type { Notices } from '../../state/notices.ts';

export function tellHandedOver(
  store: Pick<Device['store'], 'subscribe'>,
  notices: Pick<Notices, 'tell'>,
): void {
  store.subscribe(({ snapshot: { lease } }, { snapshot: before }) => {
    const giver = lease?.givenBy ?? null;
    if (lease !== null && giver !== null && giver !== before.lease?.givenBy)
      notices.tell('info', words.lease.given({ name: personName(giver, lease.you) }));
  });
}
