// The notices of the library about its condition: failures, damaged files, and changes that are stored nowhere yet. Each condition
// is reported once. Knows no document.

import { asLibraryError, type LibraryErrorCode, type Listing } from '#shared/files/documentStore.ts';
import { libraryProblem } from '../../i18n/sentences.ts';
import { words } from '../../i18n/words.ts';
import type { Notices } from '../../state/notices.ts';

export interface LibraryNotices {
  tell(error: unknown): void;
  /** As `tell`, but only for the first failure of a series; null ends the series. For the list, which is refreshed every few seconds. */
  tellListing(error: unknown): void;
  tellDamage(listing: Listing): void;
  /** Whether the browser's storage took the last change that waits for the library. */
  setOutboxStored(isStored: boolean): void;
  /** The library does not take changes; `error` says why. */
  setAway(error: unknown): void;
  /** The library has every change. */
  setSaved(): void;
}

/** Messages that no longer apply once the library has every change. */
const WAITING: readonly LibraryErrorCode[] = ['full', 'busy', 'unreachable'];

export function createLibraryNotices(notices: Notices): LibraryNotices {
  const damageShown = new Set<string>();
  let isListed = true;
  let isOutboxStored = true;
  let isAway = false;

  function tell(error: unknown): void {
    const { code, message } = asLibraryError(error);
    notices.show('warning', libraryProblem(code, message));
  }

  /** Every change is for a moment only in this page; it matters while the library is away. */
  function tellUnstored(): void {
    if (isOutboxStored || !isAway) notices.takeBack(words.library.notHeldHere);
    else notices.show('warning', words.library.notHeldHere);
  }

  return {
    tell,
    tellListing(error) {
      if (error !== null && isListed) tell(error);
      isListed = error === null;
    },
    tellDamage({ damagedFile, changesLost }) {
      const damage = damagedFile === null ? [] : [words.library.damagedFile({ file: damagedFile })];
      if (changesLost) damage.push(words.library.changesLost);
      for (const text of damage.filter((one) => !damageShown.has(one))) {
        damageShown.add(text);
        notices.show('warning', text);
      }
    },
    setOutboxStored(isStored) {
      isOutboxStored = isStored;
      tellUnstored();
    },
    setAway(error) {
      tell(error);
      isAway = true;
      tellUnstored();
    },
    setSaved() {
      isAway = false;
      tellUnstored();
      for (const code of WAITING) notices.takeBack(libraryProblem(code, ''));
    },
  };
}
