// Another group is opened: nothing of it is selected yet, all of it is in sight, and the playhead is at its beginning. Frames of two
// groups may have the same ids.

import type { Library } from '../../library/library.ts';
import { afresh, type Timeline } from './timeline.ts';
import type { View } from '../../view.ts';

export function lookAfresh(stores: {
  readonly library: Pick<Library, 'store'>;
  readonly view: View;
  readonly timeline: Timeline;
}): void {
  stores.library.store.subscribe(({ openId }, before) => {
    if (openId === before.openId) return;
    stores.view.setState({ selectedFrame: null });
    stores.timeline.setState(afresh());
  });
}
