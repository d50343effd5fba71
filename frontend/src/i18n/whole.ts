// All words in use, for parts that come later than the first load and bring theirs with them.

import { words as english } from 'virtual:words/en/rest';
import { datesIn, type Dates } from './dates.ts';
import { spoken, type Words as FirstWords } from './words.ts';

export interface Words extends FirstWords {
  readonly dates: Dates;
}

function wholeOf(now: FirstWords): Words {
  return { ...(now.locale === english.locale ? english : now), dates: datesIn(now.locale) };
}

export let words: Words = wholeOf(spoken.getState());
spoken.subscribe((now) => {
  words = wholeOf(now);
});
