// What boards are called: as their maker names them, unless a language has words of its own.

import type { Family } from '#shared/codec/families.ts';
import { words } from '../words.ts';

export function boardName({ id, name }: Pick<Family, 'id' | 'name'>): string {
  const names: Readonly<Partial<Record<Family['id'], string>>> = words.boards;
  return names[id] ?? name;
}
