// All words in use, for parts that come later than the first load and bring theirs with them.

import { wholeEnglish, type Words } from './en/whole.ts';
import { spoken } from './words.ts';

export type { Words };

const wholeOf = ({ whole }: { readonly whole: Words | null }): Words => whole ?? wholeEnglish;

export let words: Words = wholeOf(spoken.getState());
spoken.subscribe((now) => {
  words = wholeOf(now);
});
