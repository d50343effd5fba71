// Which boards there are to simulate, by name: all that a page knows of them before it simulates one.

import { FAMILIES, type FamilyId } from '../codec/families.ts';

/** There is one of each family. */
export type ProfileName = FamilyId;

export const isProfileName = (text: string): text is ProfileName => Object.hasOwn(FAMILIES, text);
