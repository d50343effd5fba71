// That the group may make the robot touch itself or the floor, where it is played and downloaded: a warning that blocks nothing.

import { Chip } from '../../../ui/Chip.tsx';
import { useCollisions } from '../../stores.ts';
import { words } from '../../../i18n/whole.ts';
import { collisionSummary } from './problemText.ts';

/** `isShort`: in a line with other chips. */
export function CollisionNote({ isShort = false }: { readonly isShort?: boolean }) {
  const summary = collisionSummary(useCollisions(({ places }) => places));
  if (summary === null) return null;
  return <Chip truth="warning">{isShort ? words.collision.short : summary}</Chip>;
}
